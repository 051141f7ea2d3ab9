// The warps of the unit square, the random numbers and the camera rays, as the shaders compute them.
#include "engine/path/frame_constants.h"
#include "kernels/path.h"
#include "kernels/shaders.h"
#include "shared/path.h"
#include "shared/queue.h"
#include "tests/reference/camera_rays.h"
#include "tests/reference/ggx.h"
#include "tests/reference/random.h"
#include "tests/reference/sphere_histogram.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>

using namespace irradia;
using reference::kPi;
using reference::Vec3;
using test::toFloats;

namespace {

constexpr uint32_t kSamples = 1u << 20;

// The tests of distribution below (1 + 1 + 7 warps, 16 + 12 of random numbers, 1 of rays) fail together by
// chance once in a hundred times.
const double kLevel = reference::sidakLevel(0.01, 38);

std::vector<glm::vec4> drawWarp(uint32_t warp, uint32_t seed, const glm::vec4& view = glm::vec4(0, 0, 1, 1)) {
    test::KernelHarness kernel(kernels::sampler_warps);
    const gpu::WarpHarnessParams params{view, warp, kSamples, seed, 0};
    std::vector<glm::vec4> samples;
    for (const glm::uvec4& record : kernel.run({}, params, kSamples, kSamples))
        samples.push_back(toFloats(record));
    return samples;
}

// p-value of directions against their density.
double directionsPValue(const std::vector<glm::vec4>& samples, reference::SphereHistogram histogram,
                        const std::function<double(const Vec3&)>& pdf) {
    for (const glm::vec4& sample : samples) histogram.add(glm::normalize(Vec3(sample)));
    return histogram.test(pdf).pValue;
}

// p-value of points of the unit square against the uniform density, over bins x bins squares.
class SquareHistogram {
public:
    explicit SquareHistogram(int bins)
        : bins_(bins)
        , counts_(static_cast<size_t>(bins) * bins) {}

    void add(double x, double y) {
        const auto bin = [&](double v) { return std::clamp(static_cast<int>(v * bins_), 0, bins_ - 1); };
        counts_[static_cast<size_t>(bin(y)) * bins_ + bin(x)] += 1.0;
        ++samples_;
    }
    double pValue() const {
        const std::vector<double> expected(counts_.size(), samples_ / static_cast<double>(counts_.size()));
        return reference::chiSquareTest(counts_, expected).pValue;
    }

private:
    int bins_;
    std::vector<double> counts_;
    double samples_ = 0.0;
};

// Where the samples lie in the unit square by the inverse of the warp: uniform if the warp is right.
double trianglePValue(const std::vector<glm::vec4>& samples) {
    SquareHistogram histogram(32);
    for (const glm::vec4& b : samples) {
        const double s = double(b.x) + b.y; // the area below it grows as its square
        histogram.add(s * s, s > 0.0 ? b.y / s : 0.0);
    }
    return histogram.pValue();
}

double visibleNormalPdf(const Vec3& h, const Vec3& v, double alpha) {
    const reference::Ggx ggx{alpha};
    if (h.z <= 0.0) return 0.0;
    // G1(V) D(H) max(V.H, 0) / V.z with G1 = 2 V.z / (V.z + root).
    return 2.0 * ggx.distribution(h) * std::max(glm::dot(v, h), 0.0) / (v.z + ggx.root(v.z));
}

} // namespace

TEST_CASE("cosine-weighted directions") {
    const auto samples = drawWarp(gpu::kWarpCosineHemisphere, 1);
    const auto pdf = [](const Vec3& d) { return std::max(d.z, 0.0) / kPi; };
    const reference::SphereHistogram histogram(Vec3(0, 0, 1), 1.0);
    CHECK(directionsPValue(samples, histogram, pdf) > kLevel);
    // Planted: a density proportional to cos^1.05, which integrates to 1 too.
    CHECK(directionsPValue(samples, histogram, [](const Vec3& d) {
              return 2.05 / 2.0 / kPi * std::pow(std::max(d.z, 0.0), 1.05);
          }) < 1e-6);
}

TEST_CASE("points of a triangle are uniform in its area") {
    auto samples = drawWarp(gpu::kWarpTriangle, 2);
    for (const glm::vec4& b : samples) REQUIRE((b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f + 1e-6f));
    CHECK(trianglePValue(samples) > kLevel);
    for (glm::vec4& b : samples) b *= std::pow(b.x + b.y, 0.02f); // planted: gathered at one corner
    CHECK(trianglePValue(samples) < 1e-6);
}

TEST_CASE("visible normals of GGX") {
    struct View {
        double degrees, alpha, scale; // 1 puts the horizon, where the density jumps to 0, on an edge of bins
    };
    for (const View& c : {View{0, 1.0, 1.0}, View{45, 0.5, 1.0}, View{80, 1.0, 1.0}, View{88, 0.3, 1.0},
                          View{60, 0.04, 0.05}, View{88, 0.01, 0.01}, View{30, 1e-3, 1e-3}}) {
        const Vec3 v = reference::direction(std::cos(c.degrees / 180.0 * kPi), 0.7);
        const auto samples = drawWarp(gpu::kWarpVisibleNormal, 3, glm::vec4(glm::vec3(v), c.alpha));
        const reference::SphereHistogram histogram(Vec3(0, 0, 1), c.scale);
        INFO(c.degrees << " degrees, alpha " << c.alpha);
        CHECK(directionsPValue(samples, histogram,
                               [&](const Vec3& h) { return visibleNormalPdf(h, v, c.alpha); }) > kLevel);
        CHECK(directionsPValue(samples, histogram,
                               [&](const Vec3& h) { return visibleNormalPdf(h, v, 1.05 * c.alpha); }) < 1e-6);
    }
}

TEST_CASE("equirectangular coordinates and directions are each other's inverse") {
    // A hundredth of a texel in a picture of 4096 x 2048: what sines and arc tangents are good to in single
    // precision.
    constexpr double kError = 4e-6;
    // u of a direction near a pole is what rounding leaves of it, in proportion to 1 / sin(theta).
    for (const glm::vec4& s : drawWarp(gpu::kWarpEquirect, 4)) {
        const double du = std::abs(double(s.x) - s.z);
        REQUIRE(std::min(du, 1.0 - du) * std::sin(kPi * double(s.y)) < kError);
        REQUIRE(std::abs(double(s.y) - s.w) < kError);
    }
    reference::Random random(5);
    std::vector<glm::vec4> directions{{0, 1, 0, 0}, {0, -1, 0, 0}, {-1, 0, 0, 0}, {-1, 0, -1e-9f, 0}};
    while (directions.size() < 20000) {
        const Vec3 d = reference::direction(2.0 * random.uniform() - 1.0, 2.0 * kPi * random.uniform());
        directions.emplace_back(glm::vec3(d), 0.0f);
    }
    test::KernelHarness kernel(kernels::sampler_equirect);
    const Buffer input = test::quadBuffer(directions);
    const gpu::WarpHarnessParams params{glm::vec4(0), 0, static_cast<uint32_t>(directions.size()), 0, 0};
    const auto results = kernel.run({input}, params, directions.size(), 2 * directions.size());
    for (size_t i = 0; i < directions.size(); ++i) {
        const Vec3 d(directions[i]);
        const glm::vec4 uv = toFloats(results[2 * i]);
        const glm::vec4 back = toFloats(results[2 * i + 1]);
        INFO("direction " << d.x << ' ' << d.y << ' ' << d.z << " at " << uv.x << ' ' << uv.y);
        REQUIRE((uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f));
        REQUIRE(glm::length(Vec3(back) - d) < 2.0 * kPi * kError);
        const double sine = std::hypot(d.x, d.z);
        const double u = std::atan2(d.z, d.x) / (2.0 * kPi) + 0.5, du = std::abs(uv.x - u);
        if (sine > 0.0) REQUIRE(std::min(du, 1.0 - du) < kError);
    }
}

TEST_CASE("the power heuristic's weights") {
    reference::Random random(6);
    std::vector<glm::vec4> pairs{{0, 1, 0, 0},           {1, 0, 0, 0},         {1, 1, 0, 0},
                                 {1e30f, 1, 0, 0},       {1e20f, 1e20f, 0, 0}, {3e18f, 1e18f, 0, 0},
                                 {1e-22f, 1e-22f, 0, 0}, {1e-30f, 1e30f, 0, 0}};
    while (pairs.size() < 10000)
        pairs.emplace_back(std::exp(24.0 * random.uniform() - 12.0), std::exp(24.0 * random.uniform() - 12.0),
                           0, 0);
    test::KernelHarness kernel(kernels::sampler_heuristic);
    const Buffer input = test::quadBuffer(pairs);
    const gpu::WarpHarnessParams params{glm::vec4(0), 0, static_cast<uint32_t>(pairs.size()), 0, 0};
    const auto results = kernel.run({input}, params, pairs.size(), pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
        const glm::vec4 w = toFloats(results[i]);
        const double p = pairs[i].x, q = pairs[i].y;
        INFO("p " << p << " q " << q << " weights " << w.x << ' ' << w.y);
        REQUIRE((w.x >= 0.0f && w.y >= 0.0f && w.x <= 1.0f && w.y <= 1.0f));
        REQUIRE(std::abs(w.x - p * p / (p * p + q * q)) < 1e-6);
        REQUIRE(std::abs(double(w.x) + w.y - 1.0) < 1e-6); // no light is counted twice or lost
    }
}

namespace {

std::vector<glm::uvec4> randomBits(const glm::uvec4& first, const glm::uvec4& step, uint32_t count) {
    test::KernelHarness kernel(kernels::sampler_random_bits);
    return kernel.run({}, gpu::RngHarnessParams{first, step, count}, count, count);
}

double unit(uint32_t bits) {
    return (bits >> 8) * 0x1p-24;
}

const glm::uvec4 kSteps[] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
const char* const kStepNames[] = {"pixel", "sample", "block", "seed"};

} // namespace

TEST_CASE("random numbers are uniform along every part of the key") {
    for (int k = 0; k < 4; ++k) {
        const auto bits = randomBits({17, 3, 2, 1}, kSteps[k], kSamples);
        for (int component = 0; component < 4; ++component) {
            std::vector<double> counts(1024);
            for (const glm::uvec4& b : bits) counts[static_cast<size_t>(unit(b[component]) * 1024.0)] += 1.0;
            INFO("along " << kStepNames[k] << ", component " << component);
            CHECK(reference::chiSquareTest(counts, std::vector<double>(1024, kSamples / 1024.0)).pValue >
                  kLevel);
        }
    }
}

TEST_CASE("random numbers of neighbouring keys and of one key are independent in pairs") {
    for (int k = 0; k < 4; ++k) {
        const auto bits = randomBits({100, 0, 0, 7}, kSteps[k], kSamples + 1);
        SquareHistogram neighbours(32), within(32), across(32);
        for (size_t i = 0; i + 1 < bits.size(); ++i) {
            neighbours.add(unit(bits[i].x), unit(bits[i + 1].x));
            within.add(unit(bits[i].y), unit(bits[i].z));
            across.add(unit(bits[i].w), unit(bits[i + 1].x));
        }
        INFO("along " << kStepNames[k]);
        CHECK(neighbours.pValue() > kLevel);
        CHECK(within.pValue() > kLevel);
        CHECK(across.pValue() > kLevel);
    }
}

TEST_CASE("equal keys give equal random numbers, wherever they are computed") {
    const auto forth = randomBits({5, 6, 7, 8}, {1, 0, 0, 0}, 1000);
    const auto back = randomBits({5 + 999, 6, 7, 8}, {~0u, 0, 0, 0}, 1000);
    for (size_t i = 0; i < forth.size(); ++i) REQUIRE(forth[i] == back[forth.size() - 1 - i]);
}

TEST_CASE("camera rays are uniform in their pixels") {
    constexpr uint32_t kWidth = 64, kHeight = 32, kRays = kWidth * kHeight;
    Camera camera;
    camera.position = {1, 2, 3};
    camera.forward = glm::normalize(glm::vec3(0.3f, -0.2f, -1.0f));
    camera.up = glm::normalize(glm::cross(glm::cross(camera.forward, glm::vec3(0, 1, 0)), camera.forward));
    camera.verticalFov = 0.9f;
    const float scale = std::tan(0.5f * camera.verticalFov), aspect = float(kWidth) / kHeight;
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up)) * scale * aspect;

    Device& device = test::validatedDevice();
    const Kernel kernel(device, kernels::generate_camera_rays);
    const Buffer rays(device, "rays", kRays * gpu::kRayQuads * 16), radiance(device, "radiance", kRays * 16);
    const Buffer counters(device, "counters", gpu::kCounters * 4);
    PathTracerOptions options;
    options.width = kWidth;
    options.height = kHeight;
    const FrameUniforms uniforms = frameUniforms({}, options, camera);
    const Buffer constants(device, "frame constants", sizeof uniforms);
    FrameGraph graph(device);
    SquareHistogram jitter(32);
    constexpr uint32_t kFrames = 512;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        graph.update(constants, uniforms);
        graph.pass(kernel)
            .read(constants)
            .write(rays)
            .write(radiance)
            .readWrite(counters)
            .push(gpu::WaveParams{0, frame, 0, kRays, 0, 0})
            .dispatch(kRays);
        graph.execute();
        const auto records = download<glm::uvec4>(device, rays, kRays * gpu::kRayQuads);
        for (uint32_t path = 0; path < kRays; ++path) {
            REQUIRE(records[path * 3].w == path);
            const Vec3 d(toFloats(records[path * 3 + 1]));
            const double along = glm::dot(d, Vec3(camera.forward));
            const double x = glm::dot(d, Vec3(right)) / along / glm::dot(Vec3(right), Vec3(right));
            const double y = glm::dot(d, Vec3(camera.up)) / along / scale;
            const double px = 0.5 * (x + 1.0) * kWidth - path % kWidth,
                         py = 0.5 * (1.0 - y) * kHeight - path / kWidth;
            REQUIRE((px > -1e-4 && px < 1.0 + 1e-4 && py > -1e-4 && py < 1.0 + 1e-4)); // in its own pixel
            jitter.add(px, py);
        }
    }
    CHECK(jitter.pValue() > kLevel);
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("rays of an orthographic camera are parallel and leave their pixels") {
    constexpr uint32_t kWidth = 8, kHeight = 4, kRays = kWidth * kHeight;
    const Vec3 position(1, 2, 3), forward(0, 0, -1), right(2, 0, 0), up(0, 1, 0);
    Device& device = test::validatedDevice();
    const Kernel kernel(device, kernels::generate_camera_rays);
    const Buffer rays(device, "rays", kRays * gpu::kRayQuads * 16), radiance(device, "radiance", kRays * 16);
    const Buffer counters(device, "counters", gpu::kCounters * 4);
    FrameGraph graph(device);
    FrameUniforms uniforms{};
    uniforms.frame.seed = 1;
    uniforms.frame.width = kWidth;
    uniforms.frame.height = kHeight;
    uniforms.camera = {glm::vec4(position, 1), glm::vec4(forward, 0), glm::vec4(right, 0), glm::vec4(up, 0)};
    const Buffer constants(device, "frame constants", sizeof uniforms);
    graph.update(constants, uniforms);
    graph.pass(kernel)
        .read(constants)
        .write(rays)
        .write(radiance)
        .readWrite(counters)
        .push(gpu::WaveParams{0, 0, 0, kRays, 0, 0})
        .dispatch(kRays);
    graph.execute();
    const auto records = download<glm::uvec4>(device, rays, kRays * gpu::kRayQuads);
    for (uint32_t path = 0; path < kRays; ++path) {
        const Vec3 origin = Vec3(toFloats(records[path * 3])) - position;
        REQUIRE(Vec3(toFloats(records[path * 3 + 1])) == forward);
        REQUIRE(origin.z == 0);
        const double px = 0.5 * (origin.x / right.x + 1.0) * kWidth - path % kWidth;
        const double py = 0.5 * (1.0 - origin.y / up.y) * kHeight - path / kWidth;
        REQUIRE((px > -1e-5 && px < 1 + 1e-5 && py > -1e-5 && py < 1 + 1e-5)); // rounding of floats
    }
}
