// Light that goes straight on through surfaces: alpha by blending and by mask, clear sheets, in path and
// shadow rays, and what vertices and transformed textures add to it.
#include "tests/reference/glass_scenes.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using test::picture;

namespace {

constexpr float kClear = 0.96f; // what a sheet of index 1.5 transmits straight ahead

Device& device() {
    return test::deviceWith(QuadAccess::Texel);
}

glm::dvec3 meanOf(const FilmImage& film) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& v : film.mean) sum += glm::dvec3(v);
    return sum / double(film.mean.size());
}

// Looks along -z at [-1, 1]^2 from z = 5, rays parallel.
Camera ahead() {
    Camera camera = reference::lookAt({0, 0, 5}, glm::vec3(0.0f), 1.0f);
    camera.halfHeight = 1.0f;
    return camera;
}

// A wall before the camera, at the height z, of [-1.5, 1.5]^2, uv from 0 to 1 over [-1, 1]^2 with v
// downwards.
void addWall(Scene& scene, uint32_t material, float z) {
    const size_t first = scene.vertices.size();
    reference::addQuad(scene, material, {-1.5f, -1.5f, z}, {3, 0, 0}, {0, 3, 0});
    for (size_t i = first; i < scene.vertices.size(); ++i) {
        Vertex& v = scene.vertices[i];
        for (glm::vec2& uv : v.uv) uv = {0.5f + 0.5f * v.position.x, 0.5f - 0.5f * v.position.y};
    }
}

Material screen(float alpha, const glm::vec3& emission = glm::vec3(0.0f)) {
    Material material = reference::lambert(glm::vec3(0.0f), emission);
    material.alphaMode = AlphaMode::Blend;
    material.alpha = alpha;
    return material;
}

Material clearSheet(const glm::vec3& color = glm::vec3(1.0f)) {
    Material material;
    material.baseColor = color;
    material.metallic = material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.doubleSided = true;
    return material;
}

// A picture of 2 x 2 texels: top left, top right, bottom left, bottom right.
int addPicture(Scene& scene, const std::vector<glm::u8vec4>& texels) {
    TextureImage image{"picture", 2, 2, {}};
    for (const glm::u8vec4& t : texels) image.rgba.insert(image.rgba.end(), {t.r, t.g, t.b, t.a});
    scene.images.push_back(image);
    return static_cast<int>(scene.images.size()) - 1;
}

glm::dvec3 render(const Scene& scene, const Camera& camera, uint32_t frames, uint32_t maxBounces,
                  uint32_t size = 16) {
    const FilmImage film =
        test::GpuRenderer(device(), scene).render(camera, picture(size, maxBounces), frames);
    for (const glm::vec3& v : film.mean) REQUIRE(std::isfinite(v.x + v.y + v.z));
    CHECK(device().validationMessages() == 0);
    return meanOf(film);
}

bool agrees(double value, double expected, double tolerance = 0.005) {
    INFO(value << " against " << expected);
    return std::abs(value / expected - 1.0) < tolerance;
}

} // namespace

TEST_CASE("a blended screen shows its share of itself, and of what is behind it the rest") {
    Scene scene;
    const uint32_t lamp = reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), glm::vec3(1.0f)));
    addWall(scene, lamp, 0.0f);
    const uint32_t red = reference::addMaterial(scene, screen(0.3f, {2, 0, 0}));
    addWall(scene, red, 1.0f);
    const glm::dvec3 seen = render(scene, ahead(), 512, 0);
    // 1.3e5 samples of a coin of 0.3: sigma 1.3e-3 of 1.3, 6.6e-4 of 0.7 is 1e-3.
    CHECK(agrees(seen.r, 0.7 + 0.3 * 2.0));
    CHECK(agrees(seen.g, 0.7));
    CHECK_FALSE(agrees(seen.g, 0.71)); // a share off by a hundredth would be seen
}

TEST_CASE("passing takes nothing of the bounces, however many surfaces are passed") {
    Scene scene;
    addWall(scene, reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), glm::vec3(1.0f))), 0.0f);
    const uint32_t thin = reference::addMaterial(scene, screen(0.03f));
    for (int i = 1; i <= 20; ++i) addWall(scene, thin, 0.1f * float(i));
    // 2.6e5 paths of which 0.54 arrive: sigma 1.8e-3 of the mean.
    CHECK(agrees(render(scene, ahead(), 1024, 0).g, std::pow(0.97, 20.0), 0.006));
}

TEST_CASE("shadows of screens and coloured sheets weaken light by what they let through") {
    // A floor below a lamp, both Lambert; between them nothing, then a screen, then a sheet: seen from the
    // side, beneath what is between.
    const auto floorLight = [](const Material* between) {
        Scene scene;
        const uint32_t floor = reference::addMaterial(scene, reference::lambert(glm::vec3(0.5f)));
        reference::addQuad(scene, floor, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
        const uint32_t lamp =
            reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), glm::vec3(10.0f)));
        reference::addQuad(scene, lamp, {-0.1f, 3, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f});
        if (between)
            reference::addQuad(scene, reference::addMaterial(scene, *between), {-5, 1, 5}, {10, 0, 0},
                               {0, 0, -10});
        // Nothing of the sheet's reflection of the floor: only direct light.
        return render(scene, reference::lookAt({0, 0.9f, 0.0f}, {0, 0, 0}, 0.2f), 512, 0);
    };
    const glm::dvec3 open = floorLight(nullptr);
    const Material blend = screen(0.25f);
    CHECK(agrees(floorLight(&blend).g / open.g, 0.75));
    const Material green = clearSheet({0.2f, 0.8f, 0.5f});
    const glm::dvec3 tinted = floorLight(&green) / open;
    // Light of the lamp's 0.2 comes within 5 degrees of straight: Schlick's term moves by 1e-7.
    CHECK(agrees(tinted.r, 0.2 * kClear));
    CHECK(agrees(tinted.g, 0.8 * kClear));
    CHECK(agrees(tinted.b, 0.5 * kClear));
}

TEST_CASE("a clear white sheet in a white furnace is not to be seen") {
    Scene scene;
    scene.environment.constant = glm::vec3(1.0f);
    addWall(scene, reference::addMaterial(scene, clearSheet()), 0.0f);
    // At a slant, where it reflects much of what it does not transmit.
    const Camera camera = reference::lookAt({0, 1.2f, 0.3f}, glm::vec3(0, 0, 0), 0.3f);
    CHECK(agrees(render(scene, camera, 512, 8).g, 1.0));
    // Its reflection alone, of a sheet that transmits black, is what it does not let through.
    scene.materials[0].baseColor = glm::vec3(0.0f);
    CHECK_FALSE(agrees(render(scene, camera, 64, 8).g, 1.0));
}

TEST_CASE("the inside of a solid weakens light by the length of its way") {
    // Of the index of air, so that nothing is bent or reflected: a white sky through a slab of thickness 1/2,
    // and of it and a slab within it, whose own inside counts there.
    Scene scene;
    scene.environment.constant = glm::vec3(1.0f);
    Material solid = clearSheet();
    solid.isThin = false;
    solid.ior = 1.0f;
    solid.absorption = {1.0f, 0.2f, 0.0f};
    reference::addCuboid(scene, reference::addMaterial(scene, solid), {-2, -2, -0.25f}, {2, 2, 0.25f});
    glm::dvec3 seen = render(scene, ahead(), 32, 8);
    CHECK(agrees(seen.r, std::exp(-0.5)));
    CHECK(agrees(seen.g, std::exp(-0.1)));
    CHECK(agrees(seen.b, 1.0));
    CHECK_FALSE(agrees(seen.r, std::exp(-0.51)));
    solid.absorption = glm::vec3(0.0f, 2.0f, 0.0f);
    reference::addCuboid(scene, reference::addMaterial(scene, solid), {-1.5f, -1.5f, -0.1f},
                         {1.5f, 1.5f, 0.1f});
    seen = render(scene, ahead(), 32, 8);
    CHECK(agrees(seen.r, std::exp(-0.3)));
    CHECK(agrees(seen.g, std::exp(-0.06 - 0.4)));
}

TEST_CASE("a mask is all or nothing, from its cutoff on") {
    Scene scene;
    addWall(scene, reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), glm::vec3(1.0f))), 0.0f);
    Material leaf = reference::lambert(glm::vec3(0.0f), glm::vec3(0.0f));
    leaf.alphaMode = AlphaMode::Mask;
    leaf.alphaCutoff = 0.5f;
    leaf.baseColorTexture.image = addPicture(
        scene, {{255, 255, 255, 0}, {255, 255, 255, 255}, {255, 255, 255, 0}, {255, 255, 255, 255}});
    leaf.baseColorTexture.wrapS = Wrap::ClampToEdge;
    addWall(scene, reference::addMaterial(scene, leaf), 1.0f);
    // Alpha rises from 0 at u = 1/4 to 1 at u = 3/4: half of the picture is there.
    CHECK(agrees(render(scene, ahead(), 64, 0, 32).g, 0.5));
    scene.materials.back().alphaCutoff = 0.25f; // from u = 3/8 on
    CHECK(agrees(render(scene, ahead(), 64, 0, 32).g, 0.375));
    scene.materials.back().alphaMode = AlphaMode::Blend; // a ramp over the middle half
    CHECK(agrees(render(scene, ahead(), 256, 0, 32).g, 0.5));
}

TEST_CASE("a lamp with holes gives light by its coverage, sampled or met") {
    // Seen by a floor: by light samples and by BSDF samples together.
    Scene scene;
    const uint32_t floor = reference::addMaterial(scene, reference::lambert(glm::vec3(0.5f)));
    reference::addQuad(scene, floor, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    const uint32_t lamp = reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), glm::vec3(4.0f)));
    reference::addQuad(scene, lamp, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    const Camera camera = reference::lookAt({0, 0.5f, 1.9f}, {0, 0, 0}, 0.3f);
    const double whole = render(scene, camera, 512, 0).g;
    scene.materials[lamp].alphaMode = AlphaMode::Blend;
    scene.materials[lamp].alpha = 0.4f;
    CHECK(agrees(render(scene, camera, 512, 0).g / whole, 0.4));
}

TEST_CASE("vertices colour surfaces, and their alpha covers") {
    Scene scene;
    scene.environment.constant = glm::vec3(1.0f);
    const uint32_t wall = reference::addMaterial(scene, reference::lambert(glm::vec3(0.8f)));
    addWall(scene, wall, 0.0f);
    for (Vertex& v : scene.vertices) v.color = {0.5f, 0.25f + 0.1f * v.position.x, 1.0f, 1.0f}; // mean 1/4
    glm::dvec3 seen = render(scene, ahead(), 512, 0);
    CHECK(agrees(seen.r, 0.4));
    CHECK(agrees(seen.g, 0.2));
    CHECK(agrees(seen.b, 0.8));
    for (Vertex& v : scene.vertices) v.color.a = 0.5f;
    scene.materials[wall].alphaMode = AlphaMode::Blend;
    CHECK(agrees(render(scene, ahead(), 512, 0).r, 0.5 + 0.5 * 0.4));
    scene.materials[wall].alphaMode = AlphaMode::Opaque; // then alpha is to be ignored
    CHECK(agrees(render(scene, ahead(), 512, 0).r, 0.4));
}

TEST_CASE("an unlit surface is a lamp of its colour, textures and vertices together") {
    Scene scene;
    Material unlit = reference::lambert(glm::vec3(0.0f), {0.5f, 0.25f, 1.0f});
    unlit.isUnlit = unlit.doubleSided = true;
    addWall(scene, reference::addMaterial(scene, unlit), 0.0f);
    for (Vertex& v : scene.vertices) v.color = {1.0f, 0.5f, 0.25f, 1.0f};
    const glm::dvec3 seen = render(scene, ahead(), 4, 0);
    CHECK(agrees(seen.r, 0.5, 1e-5));
    CHECK(agrees(seen.g, 0.125, 1e-5));
    CHECK(agrees(seen.b, 0.25, 1e-5));
}

TEST_CASE("a transformed texture lies where its matrix puts it, by each wrap mode") {
    Scene scene;
    Material wall = reference::lambert(glm::vec3(0.0f), glm::vec3(1.0f));
    wall.emissiveTexture.image =
        addPicture(scene, {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}});
    addWall(scene, reference::addMaterial(scene, wall), 0.0f);
    TextureRef& ref = scene.materials[0].emissiveTexture;
    // The middle of a texel over the whole picture, by scale 0 and an offset: 0.25, 0.75, and by each mode
    // beyond 1.
    const auto shown = [&](glm::vec2 offset, Wrap wrap) {
        ref.transform = glm::mat3x2(0, 0, 0, 0, offset.x, offset.y);
        ref.wrapS = ref.wrapT = wrap;
        return render(scene, ahead(), 1, 0, 4);
    };
    CHECK(glm::length(shown({0.25f, 0.25f}, Wrap::Repeat) - glm::dvec3(1, 0, 0)) < 1e-5);
    CHECK(glm::length(shown({0.75f, 0.25f}, Wrap::Repeat) - glm::dvec3(0, 1, 0)) < 1e-5);
    CHECK(glm::length(shown({0.25f, 0.75f}, Wrap::Repeat) - glm::dvec3(0, 0, 1)) < 1e-5);
    CHECK(glm::length(shown({1.25f, 0.25f}, Wrap::Repeat) - glm::dvec3(1, 0, 0)) < 1e-5);
    CHECK(glm::length(shown({1.25f, 0.25f}, Wrap::MirroredRepeat) - glm::dvec3(0, 1, 0)) < 1e-5);
    CHECK(glm::length(shown({1.25f, 0.25f}, Wrap::ClampToEdge) - glm::dvec3(0, 1, 0)) < 1e-5);
    // A quarter turn about the middle: what was at the top right comes to the top left.
    ref.transform = glm::mat3x2(0, 1, -1, 0, 1, 0);
    ref.wrapS = ref.wrapT = Wrap::ClampToEdge;
    const FilmImage film = test::GpuRenderer(device(), scene).render(ahead(), picture(8, 0), 4);
    CHECK(glm::length(glm::dvec3(film.mean[0]) - glm::dvec3(0, 1, 0)) < 1e-5);
}

TEST_CASE("an alpha of one everywhere costs a scene no other kernels") {
    Scene scene;
    addWall(scene, reference::addMaterial(scene, screen(1.0f)), 0.0f);
    CHECK_FALSE(packScene(scene).needs.transparency);
    scene.materials[0].alpha = 0.5f;
    CHECK(packScene(scene).needs.transparency);
    scene.materials[0].alphaMode = AlphaMode::Opaque;
    CHECK_FALSE(packScene(scene).needs.transparency);
}
