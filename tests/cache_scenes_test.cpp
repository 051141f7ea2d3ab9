// Training paths of traced scenes: their inputs, and that they ask and end where the spread rule says, as
// follows in double precision from the positions that were recorded.
#include "engine/scene/lights/area_table.h"
#include "engine/scene/load_scene.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/oracle_cache.h"
#include <catch2/catch_test_macros.hpp>

using namespace irradia;
using namespace irradia::test;
using reference::CacheSettings;
using reference::CacheVertex;
using reference::CacheWalk;
using reference::kPi;
using reference::TrainingPath;
using reference::Values;
using reference::Vec3;

namespace {

struct Recorded {
    CacheSettings settings;
    gpu::CacheRule rule;
    std::vector<TrainingPath> paths;
    size_t queries = 0;
};

// Training paths of one frame: one for each pixel, or that of one pixel and after it those from surfaces.
Recorded record(const Scene& scene, const GpuScene& gpu, const Camera& camera, float spread,
                uint32_t surfacePaths = 0) {
    PathTracerOptions options;
    options.width = options.height = 64;
    options.maxBounces = 12;
    const bool fromSurfaces = surfacePaths > 0;
    NrcOptions asked = oracleOptions(options, 0.5f, fromSurfaces ? surfacePaths : 64 * 64, fromSurfaces);
    asked.config.spread = asked.config.trainingSpread = spread;
    OracleRenderer oracle(validatedDevice(), gpu, sceneBounds(scene), asked);
    oracle.render(camera, 1);
    const gpu::CacheRule rule = oracle.rule();
    Recorded recorded;
    recorded.rule = rule;
    recorded.settings.box = {Vec3(rule.boxLow), Vec3(rule.boxHigh), double(rule.boxLow.w)};
    recorded.settings.spread = recorded.settings.trainingSpread = double(spread);
    recorded.settings.deepest = rule.deepest;
    recorded.settings.lastDepth = rule.lastDepth;
    recorded.paths = oracle.trainingPaths();
    recorded.queries = oracle.queryWeights().size();
    return recorded;
}

bool isInUnitCube(const Values& inputs) {
    return std::all_of(inputs.begin(), inputs.end(), [](double x) { return x >= 0.0 && x <= 1.0; });
}

GpuScene toGpu(const Scene& scene) {
    PackedScene packed = packScene(scene);
    packAreaTable(packed);
    return uploadScene(validatedDevice(), packed, buildBvh(scene));
}

Vec3 positionOf(const Values& inputs, const reference::CacheBox& box) {
    return Vec3(inputs[0], inputs[1], inputs[2]) / box.scale + box.low;
}

Vec3 directionOf(double polar, double azimuth) {
    return reference::direction(std::cos(kPi * polar), 2.0 * kPi * (azimuth - 0.5));
}

} // namespace

TEST_CASE("what real scenes record lies in the unit cube, faces the viewer, and looks back along the path") {
    for (const std::string name : {"cornell-box", "glossy-room"}) {
        const Scene scene = loadScene(IRRADIA_BIN_DIR "/../scenes/" + name + ".glb");
        const GpuScene gpu = toGpu(scene);
        const Camera camera = scene.cameras.at(0);
        const Recorded recorded = record(scene, gpu, camera, 0.1f);
        size_t vertices = 0, outside = 0, turnedAway = 0, back = 0, ends = 0;
        for (const TrainingPath& path : recorded.paths) {
            Vec3 from(camera.position);
            std::vector<Values> all;
            for (const reference::TrainingVertex& v : path.vertices) all.push_back(v.inputs);
            if (path.end) all.push_back(*path.end);
            ends += path.end.has_value();
            for (const Values& inputs : all) {
                const Vec3 view = directionOf(inputs[3], inputs[4]),
                           normal = directionOf(inputs[5], inputs[6]);
                const Vec3 at = positionOf(inputs, recorded.settings.box);
                outside += !isInUnitCube(inputs);
                turnedAway += glm::dot(view, normal) < 0.005;
                back += glm::dot(view, glm::normalize(from - at)) > 1.0 - 1e-5; // 0.26 degrees
                from = at;
                ++vertices;
            }
        }
        INFO(name << ": " << vertices << " vertices, " << back << " look back, " << ends << " ends");
        CHECK(vertices > 5000);
        CHECK(ends > 2000);
        CHECK(outside == 0);
        CHECK(turnedAway == 0);
        // Mirrors are not recorded: what follows looks back at them.
        CHECK(double(back) > (name == "cornell-box" ? 0.999 : 0.9) * double(vertices));
    }
}

namespace {

// A closed box of Lambert walls, whose every sampled direction has the density cos / pi.
Scene lambertBox() {
    Scene scene;
    const uint32_t wall = reference::addMaterial(scene, reference::lambert(glm::vec3(0.7f), glm::vec3(0.3f)));
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 a(0.0f), b(0.0f), corner(-1.0f);
            a[(axis + 1) % 3] = b[(axis + 2) % 3] = 2.0f;
            corner[axis] = side;
            side < 0.0f ? reference::addQuad(scene, wall, corner, a, b)
                        : reference::addQuad(scene, wall, corner, b, a);
        }
    return scene;
}

const Camera kCamera = reference::lookAt({0.1f, 0.2f, 0.7f}, {0.0f, 0.1f, -1.0f}, 1.2f); // in the box

Vec3 nearestAxis(const Vec3& v) {
    Vec3 axis(0.0);
    for (int i = 0; i < 3; ++i)
        if (std::abs(v[i]) > 0.9) axis[i] = std::copysign(1.0, v[i]);
    return axis;
}

// Vertices as they follow from the positions of those that are recorded.
std::vector<CacheVertex> rebuild(const TrainingPath& path, const reference::CacheBox& box,
                                 const Vec3& camera) {
    std::vector<Values> all;
    for (const reference::TrainingVertex& v : path.vertices) all.push_back(v.inputs);
    if (path.end) all.push_back(*path.end);
    std::vector<CacheVertex> vertices;
    Vec3 origin = camera;
    for (const Values& inputs : all) {
        CacheVertex v;
        v.position = positionOf(inputs, box);
        v.geometricNormal = v.shadingNormal = nearestAxis(directionOf(inputs[5], inputs[6]));
        v.distance = glm::length(v.position - origin);
        v.view = (origin - v.position) / v.distance;
        if (!vertices.empty()) v.pdf = glm::dot(vertices.back().geometricNormal, -v.view) / kPi;
        v.goesOn = true;
        origin = v.position;
        vertices.push_back(v);
    }
    if (!vertices.empty()) vertices.back().goesOn = path.end.has_value();
    return vertices;
}

struct Agreement {
    size_t compared = 0, wrong = 0, queries = 0, unknown = 0;
};

Agreement compare(const Recorded& recorded, const CacheSettings& settings, const Vec3& camera) {
    Agreement result;
    const auto stop = [](size_t) { return false; };
    for (const TrainingPath& path : recorded.paths) {
        const CacheWalk twin = reference::walk(rebuild(path, settings.box, camera), settings, false, stop);
        if (twin.isUncertain || path.vertices.size() >= reference::kMaxRecorded) {
            result.unknown++; // of the longest, not all vertices are recorded
            continue;
        }
        result.compared++;
        result.wrong += twin.training.vertices.size() != path.vertices.size() ||
                        twin.training.end.has_value() != path.end.has_value();
        result.queries += twin.query.has_value();
    }
    return result;
}

} // namespace

TEST_CASE("traced paths ask and end where the spread rule says") {
    const Scene scene = lambertBox();
    const GpuScene gpu = toGpu(scene);
    const Camera& camera = kCamera;
    for (const float spread : {0.01f, 10.0f, 100.0f, 300.0f}) {
        const Recorded recorded = record(scene, gpu, camera, spread);
        const auto compared = [&](double factor) {
            CacheSettings settings = recorded.settings;
            settings.spread *= factor;
            settings.trainingSpread *= factor;
            return compare(recorded, settings, Vec3(camera.position));
        };
        const Agreement agreement = compared(1.0);
        INFO("c = " << spread << ": " << agreement.compared << " compared, " << agreement.unknown
                    << " unknown");
        CHECK(agreement.wrong == 0);
        CHECK(agreement.compared > 2000);
        CHECK(recorded.queries >= agreement.queries);
        CHECK(recorded.queries <= agreement.queries + agreement.unknown);
        if (spread > 1.0f) CHECK(compared(1.1).wrong > 10); // planted
    }
}

TEST_CASE("paths from surfaces end where the spread rule says, as seen from the distance they are given") {
    const Scene scene = lambertBox();
    const GpuScene gpu = toGpu(scene);
    constexpr float kDistance = 4.0f / 3.0f; // mean chord of the box of edge 2: 4 V / S
    for (const float spread : {0.01f, 10.0f, 100.0f}) {
        const Recorded recorded = record(scene, gpu, kCamera, spread, 4095);
        // The first vertex plays the primary vertex: as if the path asked there.
        const auto vertexCount = [&](const TrainingPath& path, double factor) {
            CacheSettings settings = recorded.settings;
            settings.endDepth = 0;
            settings.trainingSpread *= factor;
            const Values& first = path.vertices.front().inputs;
            const Vec3 viewer =
                positionOf(first, settings.box) + double(kDistance) * directionOf(first[3], first[4]);
            const auto stop = [](size_t) { return false; };
            const auto vertices = rebuild(path, settings.box, viewer);
            const TrainingPath twin = reference::walk(vertices, settings, false, stop).training;
            return twin.end.has_value() == path.end.has_value() ? twin.vertices.size() : 0;
        };
        size_t compared = 0, wrong = 0, planted = 0;
        REQUIRE(recorded.paths.size() == 4096);
        for (const TrainingPath& path : std::span(recorded.paths).subspan(1)) {
            REQUIRE(!path.vertices.empty());
            // Directions are recorded to 1e-4; of the longest paths, not all vertices are.
            const bool isCertain = vertexCount(path, 0.99) == vertexCount(path, 1.01);
            if (!isCertain || path.vertices.size() >= reference::kMaxRecorded) continue;
            compared++;
            wrong += vertexCount(path, 1.0) != path.vertices.size();
            planted += vertexCount(path, 1.2) != path.vertices.size();
        }
        INFO("c = " << spread << ": " << compared << " compared, " << wrong << " wrong");
        CHECK(wrong == 0);
        CHECK(compared > 3000);
        if (spread > 1.0f) CHECK(planted > 10);
    }
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
