// Views of what paths do with the cache, against what is known of them.
#include "nrc/renderer/nrc_renderer.h"
#include "tests/reference/cache.h"
#include "tests/reference/camera_rays.h"
#include "tests/reference/random.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/z_test.h"
#include "tests/support/cached_scene.h"
#include "tests/support/gpu_render.h"
#include "tests/support/validated_device.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>

using namespace irradia;
using namespace irradia::test;
using reference::Vec2;
using reference::Vec3;

namespace {

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

// Paths in it end by Russian roulette or at the last bounce alone.
Scene closedRoom() {
    Scene scene;
    Material material = reference::lambert(glm::vec3(0.5f));
    material.emission = glm::vec3(0.5f);
    addRoom(scene, reference::addMaterial(scene, material), glm::vec3(-1.0f), glm::vec3(1.0f));
    scene.cameras.push_back(reference::lookAt(glm::vec3(0.3f), glm::vec3(-1.0f), 1.2f));
    return scene;
}

constexpr float kNever = std::numeric_limits<float>::infinity();

NrcOptions viewed(uint32_t view, uint32_t maxBounces, float spread) {
    NrcOptions options;
    options.paths.width = options.paths.height = 24;
    options.paths.maxBounces = maxBounces;
    options.paths.samplesPerFrame = 2;
    options.paths.view = view;
    options.config = nrcPreset("fast");
    options.config.minRecords = 256;
    options.config.spread = options.config.trainingSpread = spread;
    return options;
}

FilmImage look(const Scene& scene, const NrcOptions& options, uint32_t frames = 2) {
    CachedScene cached(device(), scene, options);
    cached.renderer().setWarmingUp(true); // the cache is asked from the first frame on
    return cached.learn(scene.cameras[0], frames);
}

bool isEverywhere(const FilmImage& film, float number) {
    return std::ranges::all_of(film.mean, [&](const glm::vec3& pixel) { return pixel == glm::vec3(number); });
}

double sumOf(const FilmImage& film) {
    double sum = 0.0;
    for (const glm::vec3& pixel : film.mean) sum += double(pixel.r);
    return sum;
}

} // namespace

TEST_CASE("paths in a closed room that never ask have a vertex a bounce and one more") {
    for (const uint32_t maxBounces : {0u, 1u, 3u}) { // Russian roulette ends them after bounce 3
        INFO(maxBounces << " bounces");
        const FilmImage length = look(closedRoom(), viewed(gpu::kViewPathLength, maxBounces, kNever));
        CHECK(isEverywhere(length, static_cast<float>(maxBounces + 1)));
        CHECK(std::ranges::all_of(length.variance, [](const glm::vec3& v) { return v == glm::vec3(0.0f); }));
        CHECK(isEverywhere(look(closedRoom(), viewed(gpu::kViewEndVertex, maxBounces, kNever)),
                           static_cast<float>(maxBounces)));
    }
}

TEST_CASE("paths end at the vertex that is set") {
    for (const uint32_t endDepth : {0u, 2u}) {
        NrcOptions options = viewed(gpu::kViewEndVertex, 3, kNever);
        options.config.endDepth = endDepth;
        CHECK(isEverywhere(look(closedRoom(), options), static_cast<float>(endDepth)));
        // Those that go on past their query are longer, and have asked at the same vertex.
        options.config.residualShare = 1.0f;
        CHECK(isEverywhere(look(closedRoom(), options), static_cast<float>(endDepth)));
        options.paths.view = gpu::kViewPathLength;
        CHECK(isEverywhere(look(closedRoom(), options), 4.0f));
        options.config.residualShare = 0.0f;
        CHECK(isEverywhere(look(closedRoom(), options), static_cast<float>(endDepth + 1)));
    }
}

namespace {

// The twin: walks in the room, of which a Lambert vertex' rays are distributed as their cosines.
class RoomWalks {
public:
    explicit RoomWalks(const NrcOptions& options)
        : options_(options)
        , camera_(closedRoom().cameras[0], int(options.paths.width), int(options.paths.height)) {}

    reference::ImageEstimate endVertices(int samples) const {
        const int size = int(options_.paths.width);
        reference::ImageEstimate image{size, size, {}, {}};
        for (int pixel = 0; pixel < size * size; ++pixel) {
            reference::Random random(1, uint64_t(pixel));
            double sum = 0.0, squares = 0.0;
            for (int i = 0; i < samples; ++i) {
                const double number =
                    double(endVertex(camera_.through(pixel % size, pixel / size, random.uniform2()), random));
                sum += number;
                squares += number * number;
            }
            const double mean = sum / samples;
            image.mean.emplace_back(mean);
            image.variance.emplace_back((squares / samples - mean * mean) / (samples - 1.0));
        }
        return image;
    }

private:
    // Where the ray leaves the cube from -1 to 1.
    static reference::CacheVertex meet(const reference::Ray& ray) {
        const Vec3 distances = (glm::sign(ray.direction) - ray.origin) / ray.direction;
        const int axis = distances.x < distances.y ? (distances.x < distances.z ? 0 : 2)
                                                   : (distances.y < distances.z ? 1 : 2);
        reference::CacheVertex vertex;
        vertex.distance = distances[axis];
        vertex.position = ray.origin + distances[axis] * ray.direction;
        vertex.view = -ray.direction;
        vertex.geometricNormal = Vec3(0.0);
        vertex.geometricNormal[axis] = ray.direction[axis] > 0.0 ? -1.0 : 1.0;
        return vertex;
    }

    size_t endVertex(reference::Ray ray, reference::Random& random) const {
        std::vector<reference::CacheVertex> path{meet(ray)};
        const double limit = double(options_.config.spread) * reference::primaryArea(path.front());
        while (path.size() <= options_.paths.maxBounces &&
               reference::areaSpread(path, 0, path.size() - 1) <= limit) {
            const reference::CacheVertex& from = path.back();
            const Vec2 u = random.uniform2();
            const double radius = std::sqrt(u.x), angle = 2.0 * reference::kPi * u.y;
            const Vec3 local(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - u.x));
            ray = {from.position, reference::Frame(from.geometricNormal).toWorld(local)};
            path.push_back(meet(ray));
            path.back().pdf = local.z / reference::kPi;
        }
        return path.size() - 1;
    }

    NrcOptions options_;
    reference::CameraRays camera_;
};

} // namespace

TEST_CASE("where the spread ends paths, they end as the twin's do") {
    constexpr float kSpread = 150.0f; // paths end at each of the vertices after the first
    NrcOptions options = viewed(gpu::kViewEndVertex, 3, kSpread); // without Russian roulette
    constexpr uint32_t kFrames = 32;
    const FilmImage end = look(closedRoom(), options, kFrames);
    const auto agrees = [&](float spread) {
        NrcOptions twin = options;
        twin.config.spread = spread;
        const auto expected = RoomWalks(twin).endVertices(2 * int(kFrames));
        const reference::ZTestResult result = reference::zTest(toEstimate(end), expected);
        INFO(result.summary());
        return result.accepted() && std::abs(result.meanRatio - 1.0) < 4.0 * result.meanRatioSigma;
    };
    CHECK(agrees(kSpread));
    CHECK_FALSE(agrees(1.5f * kSpread)); // planted

    // Each has one vertex more than the number of its last.
    options.paths.view = gpu::kViewPathLength;
    const FilmImage length = look(closedRoom(), options, kFrames);
    for (size_t i = 0; i < end.mean.size(); ++i)
        CHECK(std::abs(length.mean[i].r - end.mean[i].r - 1.0f) < 1e-5f); // running means round
}

TEST_CASE("rays that meet nothing have no vertices") {
    Scene scene = closedRoom();
    scene.cameras[0] = reference::lookAt(glm::vec3(3.0f), glm::vec3(4.0f), 0.5f);
    for (const uint32_t view : {gpu::kViewEndVertex, gpu::kViewPathLength, gpu::kViewTrainingDensity})
        CHECK(isEverywhere(look(scene, viewed(view, 3, kNever)), 0.0f));
}

TEST_CASE("the training density is the records of the frames, at the pixels whose paths they come from") {
    const Scene scene = closedRoom();
    for (const float spread : {0.01f, kNever}) {
        CachedScene cached(device(), scene, viewed(gpu::kViewTrainingDensity, 6, spread));
        double records = 0.0;
        FilmImage film;
        constexpr uint32_t kFrames = 4;
        for (uint32_t i = 0; i < kFrames; ++i) {
            film = cached.learn(scene.cameras[0], 1);
            const CacheCounts& counts = cached.renderer().counts();
            records = counts.records + counts.skippedRecords;
            CHECK(sumOf(film) == records); // whole numbers
            CHECK(std::ranges::all_of(film.mean, [](const glm::vec3& p) {
                return p.r == std::floor(p.r) && p.r <= gpu::kMaxTrainingVertices;
            }));
        }
        CHECK(records > 100);
        CHECK(sumOf(cached.view(scene.cameras[0])) == 0.0); // nothing trains
    }
}

TEST_CASE("being looked at changes nothing that the cache learns") {
    const Scene scene = closedRoom();
    const auto weights = [&](uint32_t view) {
        CachedScene cached(device(), scene, viewed(view, 4, 0.01f));
        cached.learn(scene.cameras[0], 4);
        return trainerOf(cached.renderer()).parameters(Weights::Raw);
    };
    const auto unseen = weights(gpu::kViewPicture);
    for (const uint32_t view : {gpu::kViewEndVertex, gpu::kViewTrainingDensity}) {
        const bool isSame = weights(view) == unseen;
        CHECK(isSame);
    }
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(device().validationMessages() == 0);
}
