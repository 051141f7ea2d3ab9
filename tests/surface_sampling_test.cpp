// Points of the scene's surfaces at which training paths start: uniform over area, seen from directions
// weighted by the cosine on the sides that can be seen, whatever the wave and the form of the kernels.
#include "engine/graph/frame_graph.h"
#include "engine/path/frame_constants.h"
#include "engine/scene/gpu_scene.h"
#include "engine/scene/lights/area_table.h"
#include "kernels/path.h"
#include "shared/path.h"
#include "shared/queue.h"
#include "tests/reference/math.h"
#include "tests/reference/statistics.h"
#include "tests/support/triangle_scenes.h"
#include "tests/support/validated_device.h"
#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;
using reference::kPi;
using reference::Vec3;

namespace {

constexpr uint32_t kTriangles = 96, kSamples = 1u << 20;
constexpr float kDistance = 3.0f;
const double kLevel = reference::sidakLevel(0.01, 4); // of each test of distribution

bool isDoubleSided(uint32_t primitive) {
    return primitive % 2 == 1;
}

// Triangles whose areas differ a thousandfold, every second one double-sided.
const Scene& soup() {
    static const Scene scene = [] {
        Scene made = triangleSoup(kTriangles / 2, 1.0f, 3);
        for (uint32_t i = 0; i < kTriangles / 2; ++i) add(made, corners(triangleSoup(1, 0.1f, 100 + i), 0));
        made.materials.resize(2);
        made.materials[1].doubleSided = true;
        for (uint32_t i = 0; i < kTriangles; ++i) made.triangles[i].material = isDoubleSided(i);
        return made;
    }();
    return scene;
}

struct Plane {
    Vec3 p0, e1, e2;
    explicit Plane(uint32_t primitive) {
        const Corners c = corners(soup(), primitive);
        p0 = Vec3(c[0]), e1 = Vec3(c[1]) - p0, e2 = Vec3(c[2]) - p0;
    }
    double area() const { return 0.5 * glm::length(glm::cross(e1, e2)); }
};

// Share of the soup's area in each triangle.
std::vector<double> areaShares() {
    std::vector<double> areas;
    double sum = 0.0;
    for (uint32_t i = 0; i < kTriangles; ++i) sum += areas.emplace_back(Plane(i).area());
    for (double& area : areas) area /= sum;
    return areas;
}

struct Sample {
    Vec3 origin, direction;
    uint32_t path = 0, primitive = 0;
    double t = 0.0, u = 0.0, v = 0.0;

    auto key() const { return std::tuple(origin.x, origin.y, direction.z, primitive, t, u, v); }
};

// Of the paths `first` to `first` + `count` of a frame.
std::vector<Sample> draw(QuadAccess form, uint32_t first, uint32_t count, uint32_t frame) {
    Device& device = deviceWith(form);
    PackedScene packed = packScene(soup());
    packAreaTable(packed);
    const GpuScene scene = uploadScene(device, packed, buildBvh(soup()));
    const Kernel kernel(device, kernels::generate_surface_rays);
    const Buffer rays(device, "rays", uint64_t{count} * gpu::kRayQuads * 16),
        hits(device, "hits", uint64_t{count} * 16), passages(device, "passages", 16),
        counters(device, "counters", gpu::kCounters * 4);
    FrameUniforms uniforms{};
    uniforms.frame.seed = 1;
    uniforms.frame.triangles = scene.triangles;
    const Buffer constants(device, "frame constants", sizeof uniforms);
    FrameGraph graph(device);
    graph.update(constants, uniforms);
    graph.pass(kernel)
        .read(constants)
        .write(rays)
        .write(hits)
        .readWrite(counters)
        .read(scene.geometry)
        .read(scene.attributes)
        .read(scene.materials)
        .read(scene.textures)
        .read(scene.texels)
        .read(scene.areaTable)
        .write(passages)
        .push(gpu::SurfaceRayParams{{gpu::kFirstSurfacePath + first, frame, 0, count, 0, 0}, kDistance})
        .dispatch(count);
    graph.execute();
    REQUIRE(download<uint32_t>(device, counters, 1).front() == count);
    const auto ray = download<glm::uvec4>(device, rays, size_t{count} * gpu::kRayQuads),
               hit = download<glm::uvec4>(device, hits, count);
    std::vector<Sample> samples(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::uvec4* r = &ray[i * gpu::kRayQuads];
        const auto h = std::bit_cast<glm::vec4>(hit[i]);
        samples[i] = {Vec3(std::bit_cast<glm::vec4>(r[0])),
                      Vec3(std::bit_cast<glm::vec4>(r[1])),
                      r[0].w,
                      hit[i].y,
                      h.x,
                      h.z,
                      h.w};
    }
    return samples;
}

const std::vector<Sample>& samples() {
    static const std::vector<Sample> drawn = draw(QuadAccess::Texel, 0, kSamples, 0);
    return drawn;
}

double pValue(const std::vector<double>& counts, std::vector<double> shares) {
    for (double& share : shares) share *= kSamples;
    return reference::chiSquareTest(counts, shares).pValue;
}

// Counts of points in the unit square, over 32 x 32 of it.
class Square {
public:
    void add(double x, double y) { counts_[bin(y) * kBins + bin(x)] += 1.0; }
    double pValue() const {
        return ::pValue(counts_, std::vector<double>(kBins * kBins, 1.0 / (kBins * kBins)));
    }

private:
    static constexpr size_t kBins = 32;
    static size_t bin(double v) {
        return std::min(static_cast<size_t>(std::max(v, 0.0) * double(kBins)), kBins - 1);
    }
    std::vector<double> counts_ = std::vector<double>(kBins * kBins);
};

} // namespace

TEST_CASE("the area table gives each triangle the share of its area") {
    PackedScene packed = packScene(soup());
    CHECK(packed.areaTable.empty()); // unless it is asked for
    packAreaTable(packed);
    packAreaTable(packed);
    REQUIRE(packed.areaTable.size() == kTriangles);
    std::vector<double> shares(kTriangles);
    for (uint32_t i = 0; i < kTriangles; ++i) {
        const double keep = double(std::bit_cast<float>(packed.areaTable[i].x));
        shares[i] += keep / kTriangles;
        shares.at(packed.areaTable[i].y) += (1.0 - keep) / kTriangles;
    }
    const std::vector<double> expected = areaShares();
    // Edges are rounded to floats where a triangle is packed, keep probabilities too.
    for (uint32_t i = 0; i < kTriangles; ++i) CHECK(std::abs(shares[i] - expected[i]) < 1e-7);
    PackedScene nothing = packScene(Scene{});
    packAreaTable(nothing);
    CHECK(nothing.areaTable.empty());
}

TEST_CASE("triangles, and quarters of them, are chosen by area") {
    std::vector<double> counts(4 * kTriangles), expected;
    for (const Sample& s : samples()) {
        const double along = s.u + s.v, across = along > 0.0 ? s.v / along : 0.0;
        counts.at(4 * s.primitive + 2 * (along * along > 0.5) + (across > 0.5)) += 1.0;
    }
    for (const double share : areaShares()) expected.insert(expected.end(), 4, share / 4.0);
    CHECK(pValue(counts, expected) > kLevel);
    for (size_t i = 0; i < expected.size(); ++i) expected[i] *= i % 8 < 4 ? 1.05 : 1.0; // planted
    CHECK(pValue(counts, expected) < 1e-6);
}

TEST_CASE("points are uniform in their triangles") {
    Square square, planted;
    for (const Sample& s : samples()) {
        const double along = s.u + s.v;
        square.add(along * along, along > 0.0 ? s.v / along : 0.0);
        planted.add(along, along > 0.0 ? s.v / along : 0.0);
    }
    CHECK(square.pValue() > kLevel);
    CHECK(planted.pValue() < 1e-6);
}

TEST_CASE("directions are weighted by the cosine, on the front and on either side of what has two") {
    Square square, planted;
    double outside = 0.0, backs = 0.0, doubleSided = 0.0;
    for (const Sample& s : samples()) {
        const Plane plane(s.primitive);
        const Vec3 normal = glm::normalize(glm::cross(plane.e1, plane.e2)),
                   tangent = glm::normalize(plane.e1);
        const double cosine = -glm::dot(s.direction, normal);
        const double x = glm::dot(s.direction, tangent),
                     y = glm::dot(s.direction, glm::cross(normal, tangent));
        outside += !isDoubleSided(s.primitive) && cosine < 0.0;
        doubleSided += isDoubleSided(s.primitive);
        backs += cosine < 0.0;
        square.add(cosine * cosine, std::atan2(y, x) / (2.0 * kPi) + 0.5);
        planted.add(std::abs(cosine), std::atan2(y, x) / (2.0 * kPi) + 0.5); // uniform over the hemisphere
    }
    CHECK(square.pValue() > kLevel);
    CHECK(planted.pValue() < 1e-6);
    CHECK(outside == 0.0);
    CHECK(reference::normalTwoSided((backs - 0.5 * doubleSided) / (0.5 * std::sqrt(doubleSided))) > kLevel);
}

TEST_CASE("the rays lead to their points, from the distance that is asked for") {
    double worst = 0.0, worstLength = 0.0;
    for (size_t i = 0; i < samples().size(); ++i) {
        const Sample& s = samples()[i];
        REQUIRE(
            (s.path == i && s.t == double(kDistance) && s.u >= 0.0 && s.v >= 0.0 && s.u + s.v < 1.0 + 1e-6));
        const Plane plane(s.primitive);
        const Vec3 point = plane.p0 + s.u * plane.e1 + s.v * plane.e2;
        worst = std::max(worst, glm::length(s.origin + s.t * s.direction - point));
        worstLength = std::max(worstLength, std::abs(glm::length(s.direction) - 1.0));
    }
    CHECK(worst < 3e-6); // roundings of coordinates up to 5
    CHECK(worstLength < 1e-6);
}

TEST_CASE("a path's point follows from its number and frame alone, in both forms of the kernels") {
    const auto areSame = [](const std::vector<Sample>& a, size_t from) {
        return std::ranges::equal(a, std::span(samples()).subspan(from, a.size()),
                                  [](const Sample& x, const Sample& y) { return x.key() == y.key(); });
    };
    CHECK(areSame(draw(QuadAccess::Texel, 0, 1000, 0), 0));
    CHECK(areSame(draw(QuadAccess::Texel, 777, 1000, 0), 777)); // another wave
    CHECK(areSame(draw(QuadAccess::Storage, 0, 1000, 0), 0));
    CHECK_FALSE(areSame(draw(QuadAccess::Texel, 0, 1000, 1), 0));
    for (const QuadAccess form : {QuadAccess::Texel, QuadAccess::Storage})
        CHECK(deviceWith(form).validationMessages() == 0);
}
