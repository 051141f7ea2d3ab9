// The cache's kernels that predictions pass through, against their twins in double precision: predictions
// into radiance, and light back along training paths.
#include "engine/graph/frame_graph.h"
#include "kernels/cache.h"
#include "tests/support/cache_bench.h"
#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;
using reference::Random;
using reference::TrainingPath;
using reference::Values;
using reference::Vec3;

namespace {

std::vector<Values> manyInputs(Random& random, size_t count) {
    std::vector<Values> rows;
    while (rows.size() < count) rows.push_back(randomInputs(random));
    return rows;
}

Quads predictionRecords(const std::vector<Vec3>& predictions) {
    Quads records(std::max<size_t>(predictions.size(), 1));
    for (size_t i = 0; i < predictions.size(); ++i) records[i] = quad(predictions[i]);
    return records;
}

QuadAccess eachForm() {
    return GENERATE(QuadAccess::Texel, QuadAccess::Storage);
}

} // namespace

// ---- predictions into radiance ----

namespace {

struct Queries {
    std::vector<Values> inputs;
    std::vector<Vec3> weights, predictions;
    std::vector<uint32_t> paths; // each at most once
    size_t radiances = 0;        // paths of the wave
};

Queries randomQueries(size_t count, bool withBad) {
    Random random(count + 1);
    Queries q;
    q.inputs = manyInputs(random, count);
    q.radiances = 2 * count + 1;
    for (size_t i = 0; i < count; ++i) {
        q.weights.push_back(randomColour(random, -1.0, 3.0)); // negative: of the residual
        q.predictions.push_back(randomColour(random, -0.5, 4.0));
        if (withBad && i % 3 == 0) q.predictions[i][static_cast<int>(i / 3 % 3)] = kBadRadiance[i / 9 % 4];
        q.paths.push_back(static_cast<uint32_t>((i * 7919) % q.radiances)); // a prime: all different
    }
    return q;
}

struct Answers {
    std::vector<Vec3> radiance;
    uint32_t clamped = 0;
};

constexpr double kBefore = 0.25; // radiance that paths have already

Answers resolve(QuadAccess form, const Queries& q, bool factorise, double scale) {
    CacheBench bench(form);
    bench.set(gpu::kQueryCounter, static_cast<uint32_t>(q.inputs.size()));
    bench.set(stateOf(scale));
    Quads weights(std::max<size_t>(q.weights.size(), 1));
    for (size_t i = 0; i < q.weights.size(); ++i) weights[i] = quad(q.weights[i], q.paths[i]);
    const Buffer queries = bench.make(packInputs(q.inputs)), weightBuffer = bench.make(weights),
                 predictions = bench.make(predictionRecords(q.predictions)),
                 radiance = bench.make(Quads(q.radiances, quad(Vec3(kBefore))));
    const Kernel& kernel = bench.kernel(kernels::resolve_queries);
    FrameGraph graph(bench.device);
    graph.pass(kernel)
        .readWrite(bench.counters)
        .read(queries)
        .read(weightBuffer)
        .read(predictions)
        .read(bench.state)
        .readWrite(radiance)
        .push(gpu::ResolveParams{factorise ? 1u : 0u})
        .dispatch(512); // more than there are
    graph.execute();
    Answers answers;
    for (const glm::uvec4& r : download<glm::uvec4>(bench.device, radiance, q.radiances))
        answers.radiance.push_back(colour(r));
    answers.clamped = bench.counter(gpu::kClampedPredictions);
    return answers;
}

Answers twin(const Queries& q, bool factorise, double scale) {
    Answers answers;
    answers.radiance.assign(q.radiances, Vec3(kBefore));
    for (size_t i = 0; i < q.inputs.size(); ++i) {
        const Vec3 factor = factorise ? reference::reflectance(q.inputs[i]) : Vec3(1.0);
        const reference::Prediction p = reference::toRadiance(q.predictions[i], factor, scale);
        answers.radiance[q.paths[i]] += q.weights[i] * p.radiance;
        answers.clamped += p.isClamped;
    }
    return answers;
}

// Relative to the largest that a query can add: 3 x 4 x 2 / scale.
double worstOf(const Answers& actual, const Answers& expected, double scale) {
    double worst = 0.0;
    for (size_t i = 0; i < expected.radiance.size(); ++i)
        worst = std::max(worst,
                         difference(actual.radiance[i], expected.radiance[i], std::max(24.0 / scale, 1.0)));
    return worst;
}

} // namespace

TEST_CASE("predictions are added to their paths, weighted, scaled, and times the reflectance") {
    const QuadAccess form = eachForm();
    for (const size_t rows : {0, 1, 255, 256, 257}) {
        for (const bool factorise : {false, true}) {
            const double scale = rows == 255 ? 0.25 : rows == 256 ? 16.0 : 1.0;
            const Queries q = randomQueries(rows, true);
            const Answers actual = resolve(form, q, factorise, scale), expected = twin(q, factorise, scale);
            INFO(rows << " rows, factorise " << factorise << ", scale " << scale);
            CHECK(worstOf(actual, expected, scale) <= kRounding);
            CHECK(actual.clamped == expected.clamped);
            if (rows > 200) CHECK(expected.clamped >= rows / 4);
        }
    }
}

TEST_CASE("planted: predictions at the wrong path, without weight, scale, reflectance or clamp are found") {
    const Queries q = randomQueries(256, false);
    const Answers actual = resolve(QuadAccess::Texel, q, true, 4.0);
    const auto isFound = [&](const Queries& other, bool factorise, double scale) {
        return worstOf(actual, twin(other, factorise, scale), 4.0) > 100.0 * kRounding;
    };
    REQUIRE_FALSE(isFound(q, true, 4.0));
    CHECK(isFound(q, false, 4.0));
    CHECK(isFound(q, true, 4.01));
    Queries other = q;
    std::swap(other.paths[3], other.paths[4]);
    CHECK(isFound(other, true, 4.0));
    other = q;
    std::swap(other.inputs[3], other.inputs[4]); // the reflectance of another vertex
    CHECK(isFound(other, true, 4.0));
    other = q;
    other.weights[255] *= 1.001;
    CHECK(isFound(other, true, 4.0));
}

// ---- light back along training paths ----

namespace {

struct Propagated {
    std::vector<std::vector<Vec3>> targets;
    std::vector<uint32_t> counts;
    std::vector<double> rootSums, largest;
    uint32_t clamped = 0;
    std::vector<uint32_t> gathers; // 1 where the path has gathered light
};

std::vector<Vec3> randomPredictions(size_t count) {
    Random random(count + 3);
    std::vector<Vec3> predictions;
    while (predictions.size() < count) predictions.push_back(randomColour(random, -0.2, 3.0));
    return predictions;
}

Propagated propagate(QuadAccess form, const std::vector<TrainingPath>& paths,
                     const std::vector<Vec3>& predictions, bool factorise, double scale,
                     uint32_t frames = 1) {
    CacheBench bench(form);
    gpu::CacheState state = stateOf(scale);
    state.frames = frames;
    bench.set(state);
    const TrainingBuffers packed = packPaths(paths);
    const Buffer pathBuffer = bench.make(packed.paths), vertices = bench.make(packed.vertices),
                 queries = bench.make(packed.queries),
                 predictionBuffer = bench.make(predictionRecords(predictions)),
                 sums = bench.make(Quads(std::max<size_t>(paths.size(), 1)));
    const Kernel& kernel = bench.kernel(kernels::propagate_training);
    FrameGraph graph(bench.device);
    graph.pass(kernel)
        .readWrite(bench.counters)
        .read(pathBuffer)
        .readWrite(vertices)
        .read(queries)
        .read(predictionBuffer)
        .read(bench.state)
        .write(sums)
        .push(gpu::RecordsParams{static_cast<uint32_t>(paths.size()), 0, factorise ? 1u : 0u, 0.0f})
        .dispatch(paths.size());
    graph.execute();
    TrainingBuffers after = packed;
    after.vertices = download<glm::uvec4>(bench.device, vertices, packed.vertices.size());
    Propagated result;
    for (const TrainingPath& path : unpackPaths(after, paths.size())) {
        std::vector<Vec3>& targets = result.targets.emplace_back();
        for (const reference::TrainingVertex& v : path.vertices) targets.push_back(v.gathered);
    }
    for (const glm::uvec4& r : download<glm::uvec4>(bench.device, sums, paths.size())) {
        result.counts.push_back(r.x);
        result.rootSums.push_back(double(std::bit_cast<float>(r.y)));
        result.largest.push_back(double(std::bit_cast<float>(r.z)));
        result.gathers.push_back(r.w);
    }
    result.clamped = bench.counter(gpu::kClampedPredictions);
    return result;
}

Propagated twin(const std::vector<TrainingPath>& paths, const std::vector<Vec3>& predictions, bool factorise,
                double scale) {
    Propagated result;
    for (size_t p = 0; p < paths.size(); ++p) {
        Vec3 last(0.0);
        if (paths[p].end) {
            const Vec3 factor = factorise ? reference::reflectance(*paths[p].end) : Vec3(1.0);
            const reference::Prediction prediction = reference::toRadiance(predictions[p], factor, scale);
            last = prediction.radiance;
            result.clamped += prediction.isClamped;
        }
        result.targets.push_back(reference::targets(paths[p], last));
        result.counts.push_back(static_cast<uint32_t>(paths[p].vertices.size()));
        double& rootSum = result.rootSums.emplace_back(0.0);
        double& largest = result.largest.emplace_back(0.0);
        uint32_t& gathers = result.gathers.emplace_back(0);
        for (const reference::TrainingVertex& v : paths[p].vertices)
            if (reference::maxComponent(v.gathered) > 0.0) gathers = 1;
        for (const Vec3& target : result.targets.back()) {
            const double y = reference::luminance(target);
            rootSum += y >= 0.0 && y < reference::kLargestRadiance ? std::sqrt(y) : 0.0;
            largest = std::fmax(largest, y);
        }
    }
    return result;
}

// Relative to each path's brightest target; all terms are positive, so that rounding of up to 16 steps adds
// up to 16 x 6e-8 at most.
constexpr double kPropagated = 2e-6;

double worstOf(const Propagated& actual, const Propagated& expected) {
    double worst = actual.counts == expected.counts && actual.gathers == expected.gathers ? 0.0 : kInfinity;
    for (size_t p = 0; p < expected.targets.size(); ++p) {
        double size = 1e-3;
        for (const Vec3& t : expected.targets[p]) size = std::max(size, reference::maxComponent(t));
        if (!std::isfinite(size)) size = 1.0;
        for (size_t v = 0; v < expected.targets[p].size(); ++v)
            worst = std::max(worst, difference(actual.targets[p][v], expected.targets[p][v], size));
        worst = std::max(
            worst, difference(Vec3(actual.rootSums[p]), Vec3(expected.rootSums[p]), 8.0 * std::sqrt(size)));
        worst = std::max(worst, difference(Vec3(actual.largest[p]), Vec3(expected.largest[p]), size));
    }
    return worst;
}

} // namespace

TEST_CASE("light goes back along training paths as in the twin") {
    const QuadAccess form = eachForm();
    for (const size_t count : {1, 33, 1000}) {
        for (const bool factorise : {false, true}) {
            Random random(count);
            const std::vector<TrainingPath> paths = randomPaths(random, count);
            std::vector<Vec3> predictions = randomPredictions(count);
            for (size_t p = 0; p < count; p += 5) predictions[p].y = kBadRadiance[p / 5 % 4];
            const double scale = count == 33 ? 16.0 : 0.25;
            const Propagated actual = propagate(form, paths, predictions, factorise, scale),
                             expected = twin(paths, predictions, factorise, scale);
            INFO(count << " paths, factorise " << factorise);
            CHECK(worstOf(actual, expected) <= kPropagated);
            CHECK(actual.clamped == expected.clamped);
            if (count == 1000) CHECK(expected.clamped > 50);
        }
    }
}

TEST_CASE("a cache that has learned nothing adds nothing to targets") {
    Random random(8);
    std::vector<TrainingPath> paths = randomPaths(random, 200);
    const std::vector<Vec3> predictions = randomPredictions(200);
    const Propagated actual = propagate(QuadAccess::Texel, paths, predictions, true, 4.0, 0);
    CHECK(worstOf(actual, twin(paths, predictions, true, 4.0)) > 0.1);
    for (TrainingPath& path : paths) path.end.reset();
    CHECK(worstOf(actual, twin(paths, predictions, true, 4.0)) <= kPropagated);
}

TEST_CASE("planted: a step too few, the reflectance of another vertex, self-training where none is due") {
    Random random(5);
    const std::vector<TrainingPath> paths = randomPaths(random, 64);
    const std::vector<Vec3> predictions = randomPredictions(64);
    const Propagated actual = propagate(QuadAccess::Texel, paths, predictions, true, 4.0);
    const auto isFound = [&](const std::vector<TrainingPath>& other, double scale = 4.0) {
        return worstOf(actual, twin(other, predictions, true, scale)) > 100.0 * kPropagated;
    };
    REQUIRE_FALSE(isFound(paths));
    CHECK(isFound(paths, 4.01));
    const auto longest = [](std::vector<TrainingPath>& all) -> TrainingPath& {
        return *std::find_if(all.begin(), all.end(),
                             [](const TrainingPath& p) { return p.end && p.vertices.size() > 6; });
    };
    std::vector<TrainingPath> other = paths;
    longest(other).vertices[5].throughput = Vec3(0.0); // the path is cut
    CHECK(isFound(other));
    other = paths;
    longest(other).end = longest(other).vertices.back().inputs;
    CHECK(isFound(other));
    other = paths;
    longest(other).end.reset();
    CHECK(isFound(other));
    other = paths;
    std::swap(longest(other).vertices[0].throughput, longest(other).vertices[1].throughput);
    CHECK(isFound(other));
}

TEST_CASE("the device has nothing to say against it") {
    for (const QuadAccess form : {QuadAccess::Texel, QuadAccess::Storage})
        CHECK(deviceWith(form).validationMessages() == 0);
}
