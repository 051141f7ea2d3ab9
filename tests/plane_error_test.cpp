// The bounds by which rays keep off the surfaces they leave and end at: enough that none hits its own
// surface, for triangles of any size, place and shape, and not much more.
#include "kernels/shaders.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/triangle_scenes.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr uint32_t kCases = 1u << 18;

float logUniform(Random& random, float low, float high) {
    return low * std::pow(high / low, random.uniform());
}

// Edges from 1e-4 to 1e4, up to 30 times longer than wide, up to 1e6 of them away.
std::vector<glm::vec4> triangles(uint32_t seed, bool leave) {
    Random random(seed);
    std::vector<glm::vec4> records;
    for (uint32_t i = 0; i < kCases; ++i) {
        const float size = logUniform(random, 1e-4f, 1e4f);
        const glm::vec3 along = random.direction(), across = glm::cross(along, random.direction());
        const glm::vec3 e1 = size * along,
                        e2 = size * (logUniform(random, 0.03f, 1.0f) * glm::normalize(across) +
                                     (2 * random.uniform() - 1) * along);
        const glm::vec3 p0 = size * logUniform(random, 0.01f, 1e6f) * random.inCube();
        const float root = std::sqrt(random.uniform()), v = root * random.uniform();
        glm::vec3 way = random.direction();
        // Every second one within some thousandths of the horizon, but not of its rounding.
        const glm::vec3 normal = glm::normalize(glm::cross(e1, e2));
        if (i % 2 == 0) way -= (1.0f - logUniform(random, 1e-3f, 0.1f)) * glm::dot(way, normal) * normal;
        records.emplace_back(p0, root - v);
        records.emplace_back(e1, v);
        records.emplace_back(e2, 0.0f);
        records.emplace_back(glm::normalize(way), leave ? 0.0f : size * logUniform(random, 0.1f, 1e4f));
    }
    return records;
}

struct Outcome {
    uint32_t hits = 0;
    std::vector<glm::vec4> results;
};

Outcome trace(const std::vector<glm::vec4>& cases, float fault = 1.0f) {
    KernelHarness kernel(kernels::plane_error, {floatConstant(40, fault)});
    Outcome outcome;
    const Buffer input = quadBuffer(cases);
    for (const glm::uvec4& record : kernel.run({input}, gpu::PlaneErrorParams{kCases}, kCases, kCases)) {
        outcome.results.push_back(toFloats(record));
        outcome.hits += outcome.results.back().x != 0.0f;
    }
    return outcome;
}

} // namespace

TEST_CASE("no ray hits the triangle that it leaves, nor the one it ends before") {
    for (const bool leave : {true, false}) {
        INFO((leave ? "leaving" : "ending"));
        const auto cases = triangles(1, leave);
        CHECK(trace(cases).hits == 0);
        CHECK(trace(cases, 0.02f).hits > 100); // a bound too small is found out
    }
}

TEST_CASE("the bounds are a few roundings of what they bound") {
    for (const bool leave : {true, false}) {
        const auto cases = triangles(2, leave);
        const Outcome outcome = trace(cases);
        float worst = 0.0f;
        for (uint32_t i = 0; i < kCases; ++i) {
            const glm::vec3 p0(cases[4 * i]), e1(cases[4 * i + 1]), e2(cases[4 * i + 2]);
            const float shape = glm::length(e1) * glm::length(e2) / glm::length(glm::cross(e1, e2));
            const float size = glm::length(e1) + glm::length(e2) + cases[4 * i + 3].w;
            worst = std::max(worst, outcome.results[i].y / (glm::length(p0) + size * shape));
        }
        CHECK(worst < 16 * 0x1p-24f);
    }
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
