// Direct light of points, spots and directional lights on a Lambert floor, as the path tracer shows it,
// against closed forms: alone, and beside triangles and an environment.
#include "tests/reference/random.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <numbers>

using namespace irradia;
using namespace irradia::test;
using reference::kPi;
using reference::Vec3;
using Kind = PunctualLight::Kind;

namespace {

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

const Vec3 kUp(0, 1, 0);
const glm::vec3 kAlbedo(0.8f, 0.5f, 0.3f);
constexpr double kTolerance = 0.005; // of a picture's mean

constexpr double radians(double degrees) {
    return degrees / 180.0 * kPi;
}

Scene withFloor() {
    Scene scene;
    reference::addQuad(scene, reference::addMaterial(scene, reference::lambert(kAlbedo)), {-10, 0, 10},
                       {20, 0, 0}, {0, 0, -20});
    return scene;
}

PunctualLight pointAt(const glm::vec3& position, const glm::vec3& intensity = {3, 4, 5}) {
    PunctualLight light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

PunctualLight spotAt(const glm::vec3& position, const glm::vec3& towards, double inner, double outer) {
    PunctualLight light = pointAt(position);
    light.kind = Kind::Spot;
    light.direction = glm::normalize(towards - position);
    light.innerAngle = static_cast<float>(radians(inner));
    light.outerAngle = static_cast<float>(radians(outer));
    return light;
}

PunctualLight directional(const glm::vec3& direction) {
    PunctualLight light = pointAt({});
    light.kind = Kind::Directional;
    light.direction = glm::normalize(direction);
    return light;
}

// Irradiance of a point of the floor, as KHR_lights_punctual states it.
Vec3 irradiance(const PunctualLight& light, const Vec3& at) {
    if (light.kind == Kind::Directional)
        return Vec3(light.intensity) * std::max(glm::dot(-Vec3(light.direction), kUp), 0.0);
    const Vec3 to = Vec3(light.position) - at;
    const double d = glm::length(to);
    double factor = std::max(to.y, 0.0) / (d * d * d);
    if (light.range > 0.0f) factor *= std::max(1.0 - std::pow(d / light.range, 4.0), 0.0);
    if (light.kind == Kind::Spot) {
        const double outer = std::cos(double(light.outerAngle)), inner = std::cos(double(light.innerAngle));
        const double cosine = glm::dot(Vec3(light.direction), -to / d);
        const double within = std::clamp((cosine - outer) / std::max(inner - outer, 0.001), 0.0, 1.0);
        factor *= within * within;
    }
    return Vec3(light.intensity) * factor;
}

// Share of the light over the floor's point that a triangle above it subtends (Lambert 1760).
double formFactor(const Vec3 (&corners)[3], const Vec3& at) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const Vec3 a = glm::normalize(corners[k] - at), b = glm::normalize(corners[(k + 1) % 3] - at);
        const Vec3 edge = glm::cross(a, b);
        sum += std::atan2(glm::length(edge), glm::dot(a, b)) * glm::dot(glm::normalize(edge), kUp);
    }
    return std::abs(sum) / (2.0 * kPi);
}

// All lights of a scene whose triangles, but for those of the floor, face it and hide none of them but the
// sky.
Vec3 irradianceOf(const Scene& scene, const Vec3& at) {
    Vec3 sum = kPi * Vec3(scene.environment.constant);
    for (const PunctualLight& light : scene.lights) sum += irradiance(light, at);
    for (const Triangle& t : scene.triangles) {
        const Vec3 emission(scene.materials[t.material].emission);
        if (emission == Vec3(0.0)) continue;
        Vec3 corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = scene.vertices[t.vertex[k]].position;
        sum += kPi * formFactor(corners, at) * (emission - Vec3(scene.environment.constant));
    }
    return sum;
}

// What is seen of the floor: a square around a point of it.
struct View {
    Vec3 center{0.0};
    double half = 0.5;
};

Vec3 expectedMean(const Scene& scene, const View& view) {
    constexpr int kSteps = 200;
    Vec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const Vec3 offset((2 * i + 1.0) / kSteps - 1.0, 0.0, (2 * j + 1.0) / kSteps - 1.0);
            sum += irradianceOf(scene, view.center + view.half * offset);
        }
    return sum * (Vec3(kAlbedo) / (kPi * kSteps * kSteps));
}

Vec3 meanOf(const FilmImage& film) {
    Vec3 sum(0.0);
    for (const glm::vec3& v : film.mean) sum += Vec3(v);
    return sum / double(film.mean.size());
}

FilmImage look(const Scene& scene, const View& view, uint32_t frames, uint32_t bounces = 0) {
    Camera camera = reference::lookAt(glm::vec3(view.center + 0.2 * kUp), glm::vec3(view.center), 1.0f);
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    camera.halfHeight = static_cast<float>(view.half);
    PathTracerOptions options;
    options.width = options.height = 16;
    options.samplesPerFrame = 64;
    options.maxBounces = bounces;
    return GpuRenderer(device(), scene).render(camera, options, frames);
}

bool agree(const Vec3& seen, const Vec3& expected) {
    return glm::all(glm::lessThanEqual(glm::abs(seen - expected), kTolerance * expected));
}

Scene withLamp(const PunctualLight& lamp) {
    Scene scene = withFloor();
    scene.lights = {lamp};
    return scene;
}

// The lamp's picture has the closed form's mean, and not that of a lamp 5 % off.
void checkLamp(const PunctualLight& lamp, const View& view,
               const std::function<void(PunctualLight&)>& plant) {
    const Scene scene = withLamp(lamp);
    const Vec3 seen = meanOf(look(scene, view, 4)), expected = expectedMean(scene, view);
    PunctualLight other = lamp;
    plant(other);
    INFO("seen " << seen.x << ", expected " << expected.x << ", around " << view.center.x);
    CHECK(expected.x > 0.0);
    CHECK(agree(seen, expected));
    CHECK_FALSE(agree(seen, expectedMean(withLamp(other), view)));
}

const auto kBrighter = [](PunctualLight& light) { light.intensity *= 1.05f; };

// Of `triangles` small lamps, as many points and spots, beneath them so that no triangle hides one.
Scene mixedScene(int triangles, int lamps, uint64_t seed) {
    reference::Random random(seed);
    Scene scene = withFloor();
    const auto anywhere = [&](double low, double high) {
        return glm::vec3(4.0 * random.uniform() - 2.0, low + (high - low) * random.uniform(),
                         4.0 * random.uniform() - 2.0);
    };
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 emission(50.0 * random.uniform(), 20.0, 50.0 * random.uniform());
        const uint32_t material =
            reference::addMaterial(scene, reference::lambert(glm::vec3(0.0f), emission));
        const glm::vec3 corner(0.4f * static_cast<float>(i % 10) - 2.0f, 2.0f,
                               0.4f * static_cast<float>(i / 10) - 2.0f);
        const auto first = static_cast<uint32_t>(scene.vertices.size());
        for (const glm::vec3& p : {corner, corner + glm::vec3(0.2f, 0, 0), corner + glm::vec3(0, 0, 0.2f)}) {
            Vertex vertex;
            vertex.position = p;
            vertex.normal = {0, -1, 0};
            scene.vertices.push_back(vertex);
        }
        scene.triangles.push_back({{first, first + 1, first + 2}, material});
    }
    for (int i = 0; i < lamps; ++i) {
        scene.lights.push_back(pointAt(anywhere(0.5, 1.5), {random.uniform(), 0.5, random.uniform()}));
        if (i % 3 == 0) scene.lights.back().range = static_cast<float>(1.0 + 2.0 * random.uniform());
        const double outer = 20.0 + 50.0 * random.uniform(),
                     inner = i % 4 == 0 ? outer : 20.0 * random.uniform();
        PunctualLight spot = spotAt(anywhere(0.5, 1.5), anywhere(0.0, 0.0), inner, outer);
        spot.intensity = {1.0, random.uniform(), random.uniform()};
        scene.lights.push_back(spot);
    }
    return scene;
}

} // namespace

TEST_CASE("a point lights a floor by its intensity over the squared distance, as far as its range") {
    checkLamp(pointAt({0.3f, 1.0f, -0.2f}), {}, kBrighter);
    checkLamp(pointAt({0.0f, 0.25f, 0.0f}), {{0.5, 0.0, 0.2}, 0.2}, kBrighter);
    PunctualLight near = pointAt({0.0f, 1.0f, 0.0f});
    near.range = 1.4f;
    const auto farther = [](PunctualLight& light) { light.range *= 1.05f; };
    checkLamp(near, {}, kBrighter);
    checkLamp(near, {}, farther);
    checkLamp(near, {{0.8, 0.0, 0.0}, 0.3}, farther); // across its end
    CHECK(meanOf(look(withLamp(near), {{2.0, 0.0, 0.0}, 0.5}, 1)) == Vec3(0.0));
}

TEST_CASE("a spot lights all within its inner angle, nothing beyond its outer one, and fades in between") {
    const PunctualLight spot = spotAt({0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 20.0, 40.0);
    const auto viewAt = [](double degrees) {
        return View{{2.0 * std::tan(radians(degrees)), 0.0, 0.0}, 0.1};
    };
    checkLamp(spot, viewAt(0.0), kBrighter);
    checkLamp(spot, viewAt(30.0), kBrighter);
    checkLamp(spot, viewAt(30.0), [](PunctualLight& light) { light.innerAngle *= 1.05f; });
    checkLamp(spot, viewAt(38.0), [](PunctualLight& light) { light.outerAngle *= 1.01f; });
    CHECK(meanOf(look(withLamp(spot), viewAt(46.0), 1)) == Vec3(0.0));
    PunctualLight tilted = spotAt({1.0f, 1.0f, 0.5f}, {0.2f, 0.0f, -0.3f}, 10.0, 30.0);
    tilted.range = 3.0f;
    checkLamp(tilted, {}, kBrighter);
    checkLamp(spotAt({0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 15.0, 15.0), {{0.4, 0.0, 0.0}, 0.3}, kBrighter);
}

TEST_CASE("a directional light lights a floor by the cosine, and nothing from beneath") {
    checkLamp(directional({0, -1, 0}), {}, kBrighter);
    checkLamp(directional({1, -1, 2}), {{3.0, 0.0, 1.0}, 1.0}, kBrighter);
    CHECK(meanOf(look(withLamp(directional({1, 1, 2})), {}, 1)) == Vec3(0.0));
}

TEST_CASE("no mirror shows a light without extent, and under a smooth coat the floor alone does") {
    Scene scene = withLamp(directional({0, -1, 0})); // seen in the mirror's own direction
    Material& floor = scene.materials[0];
    floor.metallic = 1.0f, floor.roughness = 0.0f;
    CHECK(meanOf(look(scene, {}, 1, 3)) == Vec3(0.0));
    floor.metallic = 0.0f, floor.specular = 1.0f;
    const Vec3 lambert = Vec3(kAlbedo) * Vec3(scene.lights[0].intensity) / kPi;
    const double layer = 1.0 - 0.04; // which straight light passes once, as Appendix B has it
    CHECK(agree(meanOf(look(scene, {}, 1)), layer * lambert));
    floor.roughness = 0.3f; // a lobe that shows it
    CHECK(meanOf(look(scene, {}, 1)).x > 1.2 * lambert.x);
}

TEST_CASE("lights of all kinds together give the sum of their light") {
    const auto check = [](const Scene& scene, uint32_t frames) {
        const View view{{0.2, 0.0, -0.1}, 0.6};
        const Vec3 seen = meanOf(look(scene, view, frames)), expected = expectedMean(scene, view);
        INFO("seen " << seen.x << ' ' << seen.y << ' ' << seen.z << ", expected " << expected.x << ' '
                     << expected.y << ' ' << expected.z);
        CHECK(agree(seen, expected));
        Scene other = scene;
        for (PunctualLight& light : other.lights) light.intensity *= 1.05f;
        CHECK_FALSE(agree(seen, expectedMean(other, view)));
    };
    Scene few = mixedScene(2, 2, 41);
    check(few, 64);
    Scene many = mixedScene(60, 30, 42);
    check(many, 64);
    many.lights.push_back(directional({3, -1, 1})); // low enough to pass beneath the triangles
    many.lights.push_back(directional({-1, -1, 3}));
    many.environment.constant = {0.3f, 0.4f, 0.6f};
    check(many, 64);
    few.triangles.resize(2); // the floor's
    few.environment.constant = {0.3f, 0.4f, 0.6f};
    check(few, 64);
    CHECK(device().validationMessages() == 0);
}
