// Surfaces and textures as the shaders load them from a scene's records, against the double-precision
// reference.
#include "engine/scene/gpu_scene.h"
#include "kernels/shaders.h"
#include "shared/path.h"
#include "tests/reference/random.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/surface.h"
#include "tests/reference/texture.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"
#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using reference::Random;
using reference::Vec3;
using test::toFloats;

namespace {

TextureImage noise(int width, int height, Random& random) {
    TextureImage image{"noise", width, height, {}};
    for (int i = 0; i < 4 * width * height; ++i)
        image.rgba.push_back(static_cast<uint8_t>(256 * random.uniform()));
    return image;
}

// A normal map: texels of the upper half of the sphere.
TextureImage bumps(int size, Random& random) {
    TextureImage image{"bumps", size, size, {}};
    for (int i = 0; i < size * size; ++i) {
        const Vec3 n = reference::direction(0.3 + 0.7 * random.uniform(), 6.28 * random.uniform());
        for (int k = 0; k < 3; ++k)
            image.rgba.push_back(static_cast<uint8_t>(std::lround(127.5 * (n[k] + 1.0))));
        image.rgba.push_back(255);
    }
    return image;
}

TextureRef use(int image, int uvSet, Wrap wrapS, Wrap wrapT) {
    return {image, uvSet, wrapS, wrapT};
}

// Random triangles with vertex normals and tangents; materials with and without each kind of texture.
Scene randomScene(int triangles) {
    Random random(41);
    const auto real = [&](double from, double to) {
        return static_cast<float>(from + (to - from) * random.uniform());
    };
    const auto point = [&](double size) {
        return glm::vec3(real(-size, size), real(-size, size), real(-size, size));
    };
    Scene scene;
    scene.images = {noise(8, 4, random), noise(5, 7, random), bumps(8, random)};
    for (int i = 0; i < 12; ++i) {
        Material m;
        m.baseColor = {real(0, 1), real(0, 1), real(0, 1)};
        m.metallic = real(0, 1), m.roughness = real(0, 1), m.specular = real(0, 1), m.ior = real(1, 2.5);
        m.specularColor = {real(0, 1), real(0, 1), real(0, 1)};
        m.normalScale = real(0.5, 1.5);
        const Wrap wraps[] = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge};
        if (i & 1) m.baseColorTexture = use(0, 0, wraps[i % 3], wraps[(i + 1) % 3]);
        if (i & 2) m.metallicRoughnessTexture = use(1, 1, wraps[(i + 1) % 3], wraps[i % 3]);
        if (i & 4) m.normalTexture = use(2, 0, Wrap::Repeat, Wrap::Repeat);
        if (i & 8) m.specularTexture = use(0, 1, Wrap::Repeat, wraps[i % 3]);
        if (i & 8) m.specularColorTexture = use(1, 0, wraps[i % 3], Wrap::Repeat);
        scene.materials.push_back(m);
    }
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 p = point(10), e1 = point(1), e2 = point(1);
        const glm::vec3 n = glm::normalize(glm::cross(e1, e2));
        const float hand = i % 2 ? 1.0f : -1.0f;
        for (const glm::vec3& q : {p, p + e1, p + e2}) {
            Vertex v;
            v.position = q;
            v.normal = glm::normalize(n + point(0.3));
            v.tangent = glm::vec4(glm::normalize(e1 + point(0.2)), hand);
            v.uv[0] = {real(-2, 3), real(-2, 3)};
            v.uv[1] = {real(-2, 3), real(-2, 3)};
            scene.vertices.push_back(v);
        }
        const auto first = static_cast<uint32_t>(3 * i);
        scene.triangles.push_back({{first, first + 1, first + 2}, static_cast<uint32_t>(i) % 12});
    }
    return scene;
}

struct Query {
    reference::Ray ray; // from one unit off the surface to the point
    reference::Hit hit;
};

std::vector<Query> randomQueries(const Scene& scene, size_t count) {
    Random random(42);
    const auto shapes = reference::triangleShapes(scene);
    std::vector<Query> queries;
    for (size_t i = 0; i < count; ++i) {
        const auto t = static_cast<uint32_t>(i % shapes.size());
        const double s = std::sqrt(random.uniform()), r = random.uniform();
        const float u = static_cast<float>(s * (1.0 - r)), v = static_cast<float>(s * r);
        const Vec3 view(
            glm::vec3(reference::direction(2.0 * random.uniform() - 1.0, 6.28 * random.uniform())));
        queries.push_back({{Vec3(0.0), -view}, {1.0, u, v, t}});
    }
    return queries;
}

// What the shader loads: 5 records for each query (scene_load_surface.comp).
std::vector<glm::uvec4> loadSurfaces(const Scene& scene, const std::vector<Query>& queries) {
    const GpuScene gpu = uploadScene(test::validatedDevice(), packScene(scene), Bvh{});
    std::vector<glm::uvec4> records;
    for (const Query& q : queries) {
        records.emplace_back(glm::uvec3(std::bit_cast<glm::uvec3>(glm::vec3(-q.ray.direction))),
                             q.hit.triangle);
        records.push_back(test::toQuad(glm::vec4(q.hit.u, q.hit.v, 0, 0)));
    }
    test::KernelHarness kernel(kernels::scene_load_surface, {{gpu::kConstantTextures, gpu.needs.textures}});
    const Buffer input = test::quadBuffer(records);
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(queries.size()), 0, 0, 0};
    return kernel.run({gpu.geometry, gpu.attributes, gpu.materials, gpu.textures, gpu.texels, input}, params,
                      queries.size(), 5 * queries.size());
}

} // namespace

TEST_CASE("textures are bilinear, wrapped by texel and decoded before filtering") {
    Random random(43);
    Scene scene;
    scene.images = {noise(8, 4, random), noise(5, 7, random), noise(1, 1, random)};
    struct Use {
        TextureRef texture;
        reference::Encoding encoding;
    };
    std::vector<Use> uses;
    for (const int image : {0, 1, 2})
        for (const Wrap s : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge})
            for (const Wrap t : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
                Material m;
                m.baseColorTexture = m.metallicRoughnessTexture = use(image, 0, s, t);
                scene.materials.push_back(m);
                uses.push_back({m.baseColorTexture, reference::Encoding::Srgb});
                uses.push_back({m.baseColorTexture, reference::Encoding::Linear});
            }
    const PackedScene packed = packScene(scene);
    std::vector<glm::uvec4> queries;
    for (size_t i = 0; i < 20000; ++i) {
        const size_t k = i % uses.size();
        const glm::vec2 uv(12.0 * random.uniform() - 6.0, 12.0 * random.uniform() - 6.0);
        const glm::uvec4 codes = packed.materials[(k / 2) * gpu::kMaterialQuads + 4];
        queries.emplace_back(std::bit_cast<glm::uvec2>(uv), k % 2 == 0 ? codes.x : codes.y, 0u);
    }
    const GpuScene gpu = uploadScene(test::validatedDevice(), packed, Bvh{});
    test::KernelHarness kernel(kernels::scene_sample_texture);
    const Buffer input = test::quadBuffer(queries);
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(queries.size()), 0, 0, 0};
    const auto results =
        kernel.run({gpu.geometry, gpu.attributes, gpu.materials, gpu.textures, gpu.texels, input}, params,
                   queries.size(), queries.size());
    for (size_t i = 0; i < queries.size(); ++i) {
        const Use& u = uses[i % uses.size()];
        const glm::dvec2 uv(std::bit_cast<glm::vec2>(glm::uvec2(queries[i])));
        const glm::dvec4 expected = reference::sampleTexture(scene, u.texture, uv, u.encoding);
        INFO("image " << u.texture.image << " at " << uv.x << ' ' << uv.y);
        // Halves hold 11 bits; u times the width rounds at 1e-6 of a texel.
        for (int c = 0; c < 4; ++c)
            REQUIRE(std::abs(toFloats(results[i])[c] - expected[c]) <= 0x1p-11 * expected[c] + 2e-5);
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("surfaces equal the reference's: position, normals and what the BSDF is made of") {
    const Scene scene = randomScene(600);
    const std::vector<Query> queries = randomQueries(scene, 20000);
    const auto results = loadSurfaces(scene, queries);
    const auto shapes = reference::triangleShapes(scene);
    for (size_t i = 0; i < queries.size(); ++i) {
        const Query& q = queries[i];
        const auto expected = reference::surfaceAt(scene, shapes[q.hit.triangle], q.ray, q.hit);
        const auto& p = expected.bsdf.parameters();
        const auto vector = [&](size_t k) { return Vec3(toFloats(results[5 * i + k])); };
        INFO("query " << i << " of triangle " << q.hit.triangle << ", material " << q.hit.triangle % 12);
        REQUIRE(glm::length(vector(0) - expected.position) < 1e-5); // coordinates up to 12
        // The side is anyone's where the view lies in the plane but for rounding.
        if (std::abs(glm::dot(expected.geometricNormal, q.ray.direction)) < 1e-4) continue;
        REQUIRE(glm::length(vector(1) - expected.geometricNormal) < 1e-4); // slivers' normals lose digits
        // Normals and tangents are stored to 16 bits, texels to 11: each turns by up to 1e-4 and 5e-4, and a
        // map that stretches tangents (normalScale 1.5, texels not unit) by twice that.
        REQUIRE(glm::length(vector(2) - expected.shading.normal) < 2e-3);
        REQUIRE(std::abs(toFloats(results[5 * i + 2]).w - p.roughness) < 1e-3);
        const Vec3 f0 = (1.0 - p.metallic) * p.specular * p.f0 + p.metallic * p.baseColor;
        const double f90 = (1.0 - p.metallic) * p.specular + p.metallic;
        REQUIRE(glm::length(vector(3) - (1.0 - p.metallic) * p.baseColor) < 2e-3);
        REQUIRE(glm::length(vector(4) - f0) < 2e-3);
        REQUIRE(std::abs(toFloats(results[5 * i + 4]).w - f90) < 2e-3);
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}
