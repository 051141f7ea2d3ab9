// A scene packed into the quads of shaders/shared/scene.h: decoded, they give back the scene's data.
#include "engine/scene/lights/packed_lights.h"
#include "engine/scene/texture_packing.h"
#include "tests/reference/random.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/light_scenes.h"
#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <glm/gtc/packing.hpp>

using namespace irradia;
using reference::Random;
using reference::Vec3;

namespace {

glm::vec4 floats(const glm::uvec4& record) {
    return std::bit_cast<glm::vec4>(record);
}

// The octahedral map's inverse as Cigolle et al. 2014 state it.
Vec3 decodeOctahedral(uint32_t code) {
    const glm::dvec2 p(glm::unpackSnorm2x16(code));
    Vec3 v(p.x, p.y, 1.0 - std::abs(p.x) - std::abs(p.y));
    if (v.z < 0.0)
        v = {(1.0 - std::abs(p.y)) * (p.x >= 0.0 ? 1.0 : -1.0),
             (1.0 - std::abs(p.x)) * (p.y >= 0.0 ? 1.0 : -1.0), v.z};
    return glm::normalize(v);
}

Vertex vertexWithNormal(const glm::vec3& normal) {
    Vertex v;
    v.normal = normal;
    v.tangent = glm::vec4(normal.y, normal.z, normal.x, normal.x < 0.0f ? -1.0f : 1.0f);
    v.position = 3.0f * normal;
    v.uv[0] = {normal.x, normal.y};
    v.uv[1] = {normal.z, -normal.x};
    return v;
}

TextureImage gradient(const char* name, int width, int height) {
    TextureImage image{name, width, height, {}};
    for (int i = 0; i < width * height; ++i)
        image.rgba.insert(image.rgba.end(), {uint8_t(i), uint8_t(3 * i), uint8_t(255 - i), uint8_t(7 * i)});
    return image;
}

// One triangle for every three normals; a material with a texture, so that there are attributes.
Scene sceneOfNormals(const std::vector<glm::vec3>& normals) {
    Scene scene;
    scene.images = {gradient("gradient", 4, 4)};
    Material material;
    material.baseColorTexture.image = 0;
    scene.materials = {material};
    for (const glm::vec3& n : normals) scene.vertices.push_back(vertexWithNormal(n));
    for (uint32_t i = 0; i + 2 < normals.size(); i += 3) scene.triangles.push_back({{i, i + 1, i + 2}, 0});
    return scene;
}

std::vector<glm::vec3> manyNormals() {
    std::vector<glm::vec3> normals;
    for (const float x : {-1.0f, 0.0f, 1.0f})
        for (const float y : {-1.0f, 0.0f, 1.0f})
            for (const float z : {-1.0f, 0.0f, 1.0f})
                if (x != 0.0f || y != 0.0f || z != 0.0f)
                    normals.push_back(glm::normalize(glm::vec3(x, y, z)));
    Random random(51);
    while (normals.size() < 30000)
        normals.emplace_back(reference::direction(2.0 * random.uniform() - 1.0, 6.2832 * random.uniform()));
    return normals;
}

uint64_t textureCount(const PackedScene& packed) {
    return packed.textures.size();
}

} // namespace

TEST_CASE("geometry and attributes decode to the vertices") {
    const Scene scene = sceneOfNormals(manyNormals());
    const PackedScene packed = packScene(scene);
    REQUIRE(packed.geometry.size() == scene.triangles.size() * gpu::kGeometryQuads);
    REQUIRE(packed.attributes.size() == scene.triangles.size() * gpu::kAttributeQuads);
    // A code is off by e = 1 / 65534 at most in each axis: (e, e, 2 e) before a division by a length of 1 /
    // sqrt(3) or more.
    const double kOctahedralError = std::sqrt(18.0) / 65534.0;
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const glm::uvec4* g = &packed.geometry[i * gpu::kGeometryQuads];
        const glm::uvec4* a = &packed.attributes[i * gpu::kAttributeQuads];
        const Vertex* v = &scene.vertices[3 * i];
        REQUIRE(glm::vec3(floats(g[0])) == v[0].position);
        REQUIRE(glm::vec3(floats(g[1])) == v[1].position - v[0].position);
        REQUIRE(glm::vec3(floats(g[2])) == v[2].position - v[0].position);
        REQUIRE((g[0].w == 0u && g[1].w == gpu::kNoLight));
        REQUIRE(floats(a[0]) == glm::vec4(v[0].uv[0], v[1].uv[0]));
        REQUIRE(floats(a[1]) == glm::vec4(v[2].uv[0], v[0].uv[1]));
        REQUIRE(floats(a[2]) == glm::vec4(v[1].uv[1], v[2].uv[1]));
        for (int k = 0; k < 3; ++k) {
            REQUIRE(glm::length(decodeOctahedral(g[3][k]) - Vec3(v[k].normal)) < kOctahedralError);
            REQUIRE(glm::length(decodeOctahedral(a[3][k]) - Vec3(v[k].tangent)) < kOctahedralError);
            REQUIRE((g[2].w >> k & 1u) == (v[k].tangent.w < 0.0f ? 1u : 0u));
            REQUIRE(a[3][k] != gpu::kNoTangent);
        }
    }
}

TEST_CASE("a missing tangent has the code that no direction has") {
    Scene scene = sceneOfNormals(manyNormals());
    scene.vertices[1].tangent = glm::vec4(0.0f);
    const PackedScene packed = packScene(scene);
    CHECK(packed.attributes[3].y == gpu::kNoTangent);
}

TEST_CASE("materials hold their factors; F0 is that of ior times the specular colour") {
    Scene scene;
    Material m;
    m.baseColor = {0.1f, 0.2f, 0.3f};
    m.metallic = 0.4f, m.roughness = 0.5f, m.specular = 0.6f, m.ior = 1.8f, m.normalScale = 0.7f;
    m.specularColor = {0.8f, 0.9f, 1.0f};
    m.emission = {4.0f, 5.0f, 6.0f};
    m.doubleSided = true;
    scene.materials = {Material{}, m};
    const PackedScene packed = packScene(scene);
    REQUIRE(packed.materials.size() == 2 * gpu::kMaterialQuads);
    const glm::uvec4* r = &packed.materials[gpu::kMaterialQuads];
    CHECK(floats(r[0]) == glm::vec4(m.baseColor, m.metallic));
    CHECK(floats(r[1]) == glm::vec4(m.emission, m.roughness));
    const glm::dvec3 f0 = std::pow(0.8 / 2.8, 2.0) * glm::dvec3(m.specularColor);
    CHECK(glm::length(glm::dvec3(floats(r[2])) - f0) < 1e-7);
    CHECK(floats(r[2]).w == m.specular);
    CHECK(glm::uintBitsToFloat(r[3].x) == m.normalScale);
    CHECK(r[3].y == gpu::kMaterialDoubleSided);
    CHECK(packed.materials[3].y == 0u);
    for (int k = 0; k < 4; ++k) CHECK(r[4][k] == gpu::kNoTexture);
    CHECK((r[5].x == gpu::kNoTexture && r[5].y == gpu::kNoTexture));
    CHECK(packed.attributes.empty());
    CHECK(packed.needs.textures == 0u);
}

TEST_CASE("what the scene needs of the kernels follows from its contents") {
    Scene scene;
    scene.materials = {reference::lambert(glm::vec3(0.5f))};
    SceneNeeds needs = packScene(scene).needs;
    CHECK((!needs.specular && !needs.emitters && !needs.environment));
    scene.materials[0].metallic = 1.0f;
    needs = packScene(scene).needs;
    CHECK(needs.specular);
    scene.environment.constant = glm::vec3(0.1f);
    CHECK(packScene(scene).needs.environment);
    reference::addQuad(scene, reference::addMaterial(scene, reference::lambert(glm::vec3(0), glm::vec3(1))),
                       {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    CHECK(packScene(scene).needs.emitters);
    scene.images = {gradient("gradient", 4, 4)};
    scene.materials[0].normalTexture.image = 0;
    CHECK(packScene(scene).needs.textures == gpu::kNormalTexture);
    // Without emission its texture is not needed either.
    scene.materials[0].emissiveTexture.image = 0;
    CHECK(packScene(scene).needs.textures == gpu::kNormalTexture);
}

TEST_CASE("a picture is stored once for each encoding, a record once for each way of wrapping") {
    Scene scene;
    scene.images = {gradient("gradient", 8, 4)};
    TextureRef plain;
    plain.image = 0;
    TextureRef clamped = plain, secondSet = plain;
    clamped.wrapS = Wrap::ClampToEdge;
    secondSet.uvSet = 1;
    Material a, b;
    a.baseColorTexture = plain;
    b.baseColorTexture = secondSet; // the same record: the set is in the code
    scene.materials = {a, b};
    PackedScene packed = packScene(scene);
    CHECK((textureCount(packed) == 1 && packed.texels.size() == 32));
    CHECK(packed.materials[4].x == 0u);
    CHECK(packed.materials[gpu::kMaterialQuads + 4].x == 1u);
    b.baseColorTexture = clamped;
    scene.materials = {a, b};
    packed = packScene(scene);
    CHECK((textureCount(packed) == 2 && packed.texels.size() == 32));
    CHECK(packed.textures[1] == glm::uvec4(0u, 8u, 4u, 2u));
    b.metallicRoughnessTexture = plain; // linear, no longer sRGB
    scene.materials = {a, b};
    packed = packScene(scene);
    CHECK((textureCount(packed) == 3 && packed.texels.size() == 64));
}

TEST_CASE("texels are the decoded colours rounded to halves") {
    Scene scene;
    scene.images = {gradient("gradient", 16, 16)};
    Material m;
    m.baseColorTexture.image = m.metallicRoughnessTexture.image = 0;
    scene.materials = {m};
    const PackedScene packed = packScene(scene);
    REQUIRE(packed.texels.size() == 512);
    for (const glm::uvec4& texture : packed.textures) {
        const bool srgb = texture.x == packed.textures[packed.materials[4].x >> 1].x;
        for (size_t i = 0; i < 256; ++i) {
            const glm::uvec2 halves = packed.texels[texture.x + i];
            const glm::vec4 texel(glm::unpackHalf2x16(halves.x), glm::unpackHalf2x16(halves.y));
            for (int k = 0; k < 4; ++k) {
                const double c = scene.images[0].rgba[4 * i + k] / 255.0;
                const double decoded = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
                const double exact = srgb && k < 3 ? decoded : c; // alpha is never sRGB
                REQUIRE(std::abs(texel[k] - exact) <= 0x1p-11 * exact);
            }
        }
    }
}

TEST_CASE("pictures beyond the budget are halved, largest first, and keep their mean") {
    Scene scene;
    scene.images = {gradient("large", 64, 32), gradient("small", 8, 8), gradient("odd", 33, 1)};
    TexturePacker packer(scene);
    for (int i = 0; i < 3; ++i) {
        TextureRef texture;
        texture.image = i;
        CHECK(packer.add(texture, false) == static_cast<uint32_t>(i) << 1);
    }
    std::vector<glm::uvec4> textures;
    std::vector<glm::uvec2> texels;
    std::vector<std::string> warnings;
    packer.pack(700, textures, texels, warnings);
    CHECK(texels.size() == 512 + 64 + 33);
    REQUIRE(textures.size() == 3);
    CHECK((textures[0].y == 32u && textures[0].z == 16u));
    CHECK((textures[1].y == 8u && textures[1].z == 8u));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] == "texture 'large' was reduced to 32x16 to fit");
    double mean = 0.0, exact = 0.0;
    for (size_t i = 0; i < 512; ++i) mean += glm::unpackHalf2x16(texels[textures[0].x + i].x).x / 512.0;
    for (size_t i = 0; i < 2048; ++i) exact += scene.images[0].rgba[4 * i] / 255.0 / 2048.0;
    CHECK(std::abs(mean - exact) < 1e-4);

    textures.clear(), texels.clear(), warnings.clear();
    packer.pack(8, textures, texels, warnings);
    CHECK(texels.size() <= 8);
    CHECK(warnings.size() == 3);
}

TEST_CASE("from some number of lights on their hierarchy follows them, bounds not narrower than its own") {
    const Scene scene = test::manyEmitters(100);
    const PackedScene packed = packScene(scene);
    CHECK((packed.lightCount == 100 && packed.needs.lightTree));
    REQUIRE(packed.lights.size() == 100 + 199 * gpu::kLightNodeQuads);
    for (uint32_t i = 0; i < 100; ++i) {
        CHECK(packed.lights[i].z == i); // its primitive
        CHECK(packed.geometry[i * gpu::kGeometryQuads + 1].w == i);
        uint32_t node = 0, trail = packed.lights[i].x;
        while (true) {
            const glm::uvec4& bounds = packed.lights[100 + node * gpu::kLightNodeQuads];
            const glm::uvec4& cone = packed.lights[101 + node * gpu::kLightNodeQuads];
            const glm::vec4 sphere = floats(bounds);
            for (uint32_t k = 0; k < 3; ++k) {
                const Vec3 corner(scene.vertices[3 * i + k].position);
                CHECK(glm::distance(corner, Vec3(sphere)) <= double(sphere.w));
            }
            const Vec3 p0(scene.vertices[3 * i].position), p1(scene.vertices[3 * i + 1].position);
            const Vec3 normal =
                glm::normalize(glm::cross(p1 - p0, Vec3(scene.vertices[3 * i + 2].position) - p0));
            const double cosSpread = floats(cone).y;
            if (scene.materials[i].doubleSided)
                CHECK(cosSpread == -1.0);
            else
                CHECK(std::acos(std::min(glm::dot(decodeOctahedral(cone.x), normal), 1.0)) <=
                      std::acos(cosSpread));
            if ((cone.w & gpu::kLightLeaf) != 0u) {
                CHECK((cone.w & ~gpu::kLightLeaf) == i);
                break;
            }
            node = cone.w + (trail & 1u);
            trail >>= 1;
        }
        CHECK(trail == 0u);
    }
    CHECK(floats(packed.lights[101]).z == 1.0f); // the root has all the power
}

TEST_CASE("lights have the mass of their power, the environment's texels that of luminance and solid angle") {
    constexpr uint32_t kCount = kLightTreeFrom - 1;
    const Scene scene = test::manyEmitters(kCount);
    const PackedScene packed = packScene(scene);
    REQUIRE(packed.lights.size() == kCount);
    CHECK((packed.lightCount == kCount && !packed.needs.lightTree));
    double total = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        CHECK(packed.lights[i].z == i); // its primitive
        CHECK(packed.geometry[i * gpu::kGeometryQuads + 1].w == i);
        total += glm::uintBitsToFloat(packed.lights[i].w);
    }
    CHECK(std::abs(total - 1.0) < 1e-5);

    PackedScene sky;
    packEnvironment(test::skyWithSun(16, 8), sky);
    REQUIRE((sky.environmentWidth == 16u && sky.environmentHeight == 8u));
    double mass = 0.0;
    for (const glm::uvec4& texel : sky.environment) mass += floats(texel).w / 128.0;
    CHECK(std::abs(mass - 1.0) < 1e-5);

    Environment constant;
    constant.constant = {1.0f, 2.0f, 3.0f};
    PackedScene even;
    packEnvironment(constant, even);
    REQUIRE(even.environment.size() == size_t(even.environmentWidth) * even.environmentHeight);
    for (size_t i = 0; i < even.environment.size(); ++i) {
        // density / (2 pi^2 sin(theta)) at the texel's middle is 1 / (4 pi) but for the row's curvature.
        const double v = (double(i / even.environmentWidth) + 0.5) / even.environmentHeight;
        const double pdf = floats(even.environment[i]).w /
                           (2.0 * reference::kPi * reference::kPi * std::sin(reference::kPi * v));
        REQUIRE(std::abs(pdf * 4.0 * reference::kPi - 1.0) < 1e-3);
        REQUIRE(glm::vec3(floats(even.environment[i])) == constant.constant);
    }
}

TEST_CASE("lights without extent follow the local lights, the directional ones first, but for those that "
          "give none") {
    using Kind = PunctualLight::Kind;
    Scene scene;
    for (const Kind kind : {Kind::Spot, Kind::Directional, Kind::Point, Kind::Point}) {
        PunctualLight light;
        light.kind = kind;
        light.position = {1.0f, 2.0f, 3.0f};
        light.direction = {0.0f, 0.6f, -0.8f};
        light.intensity = {4.0f, 5.0f, 6.0f};
        light.range = kind == Kind::Spot ? 8.0f : 0.0f;
        light.innerAngle = 0.3f, light.outerAngle = 0.5f;
        scene.lights.push_back(light);
    }
    scene.lights[2].intensity = glm::vec3(0.0f);
    const PackedScene packed = packScene(scene);
    CHECK((packed.lightCount == 2 && packed.directionalCount == 1 && packed.firstPunctual == 2));
    CHECK((packed.needs.punctual == (gpu::kPunctualLocal | gpu::kPunctualDirectional) &&
           !packed.needs.emitters));
    CHECK((packed.lightShares.directional == 0.5f && packed.lightShares.local == 0.5f));
    CHECK((packed.warnings.empty() && packed.lightShares.environment == 0.0f));
    REQUIRE(packed.lights.size() == 2 + 3 * gpu::kPunctualQuads);
    for (uint32_t i = 0; i < 2; ++i) {
        CHECK(packed.lights[i].z == (gpu::kPunctual | (1 + i)));
        CHECK(floats(packed.lights[i]).w == 0.5f);
    }
    const glm::uvec4* sun = &packed.lights[2];
    CHECK(floats(sun[0]) == glm::vec4(0.0f, -0.6f, 0.8f, 1.0f)); // whence it comes; always kept
    CHECK(floats(sun[1]) == glm::vec4(4.0f, 5.0f, 6.0f, 1.0f));
    const glm::uvec4* spot = sun + gpu::kPunctualQuads;
    CHECK(floats(spot[0]) == glm::vec4(1.0f, 2.0f, 3.0f, 0.125f));
    CHECK(glm::vec3(floats(spot[1])) == glm::vec3(4.0f, 5.0f, 6.0f));
    CHECK(std::abs(floats(spot[1]).w * (std::cos(0.3) - std::cos(0.5)) - 1.0) < 1e-6);
    CHECK(glm::vec3(floats(spot[2])) == glm::vec3(0.0f, 0.6f, -0.8f));
    CHECK(std::abs(floats(spot[2]).w - std::cos(0.5)) < 1e-6);
    const glm::uvec4* point = spot + gpu::kPunctualQuads;
    CHECK(floats(point[0]).w == 0.0f);
    CHECK((floats(point[1]).w == 1.0f && floats(point[2]).w <= -2.0f)); // within whatever the cosine

    scene.lights = {scene.lights[2]}; // the one that gives none
    CHECK(packScene(scene).warnings.size() == 1);
    CHECK(packScene(scene).needs.punctual == 0u);
}

TEST_CASE("where there are points and spots, cones of the hierarchy have a reach too, neither narrower than "
          "its own") {
    Scene scene = test::manyEmitters(20);
    test::addPunctualLights(scene, 20, 20, 0);
    const PackedScene packed = packScene(scene);
    REQUIRE(packed.needs.lightTree);
    const auto angles = [](uint32_t code) {
        const glm::dvec2 sines(glm::unpackUnorm2x16(code));
        return 2.0 * glm::asin(glm::min(sines, glm::dvec2(1.0)));
    };
    int spots = 0;
    for (uint32_t at = packed.lightCount; at < packed.firstPunctual; at += gpu::kLightNodeQuads) {
        const glm::uvec4& cone = packed.lights[at + 1];
        if ((cone.w & gpu::kLightLeaf) == 0u) continue;
        const uint32_t name = packed.lights[cone.w & ~gpu::kLightLeaf].z;
        const glm::dvec2 found = angles(cone.y);
        glm::dvec2 own(0.0, 0.5 * reference::kPi);
        if ((name & gpu::kPunctual) == 0u) {
            if (scene.materials[name].doubleSided) own.x = reference::kPi;
        } else {
            const glm::vec4 record = floats(
                packed.lights[packed.firstPunctual + (name & ~gpu::kPunctual) * gpu::kPunctualQuads + 2]);
            const double outer = std::acos(std::max(record.w, -1.0f));
            own = record.w < -1.0f ? glm::dvec2(reference::kPi, own.y) : glm::dvec2(outer - found.y, found.y);
            spots += record.w >= -1.0f;
        }
        CHECK(found.x >= own.x - 1e-6);
        CHECK(found.x <= own.x + 1e-3); // the margin, and a code
        CHECK(found.y >= own.y - 1e-6);
        CHECK(found.y <= own.y + 1e-4);
    }
    CHECK(spots > 10);
}
