// What paths ask the cache and record for it, against a twin in double precision: which pixels train, where
// paths ask and end, the inputs, light and throughput of each training vertex.
#include "kernels/shaders.h"
#include "shared/cache.h"
#include "shared/scene.h"
#include "tests/reference/random.h"
#include "tests/reference/statistics.h"
#include "tests/shaders/harness.h"
#include "tests/support/cache_buffers.h"
#include "tests/support/kernel_harness.h"
#include <catch2/catch_test_macros.hpp>
#include <limits>
#include <map>

using namespace irradia;
using namespace irradia::test;
using reference::CacheSettings;
using reference::CacheVertex;
using reference::CacheWalk;
using reference::kPi;
using reference::Random;
using reference::TrainingPath;
using reference::Values;
using reference::Vec3;

namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// Bound where a kernel declares more than it uses.
Buffer unused() {
    return quadBuffer(Quads(4));
}

} // namespace

// ---- which pixels train ----

namespace {

struct Tiling {
    uint32_t width, height, tilesX, tilesY;

    uint32_t pixels() const { return width * height; }
    uint32_t tiles() const { return tilesX * tilesY; }
    uint32_t tileOf(uint32_t pixel) const {
        return pixel / width * tilesY / height * tilesX + pixel % width * tilesX / width;
    }
};

// Per frame and pixel: training path + 1, or 0.
std::vector<std::vector<uint32_t>> trainingPixels(const Tiling& t, uint32_t frames) {
    static const Kernel kernel(validatedDevice(), kernels::cache_tiles);
    const uint64_t items = uint64_t{t.pixels()} * frames;
    const Buffer results(validatedDevice(), "results", items * 16);
    const Buffer scene = unused(), states = unused(), paths = unused(), vertices = unused(),
                 queries = unused(), weights = unused(), ends = unused(), counters = unused();
    FrameGraph graph(validatedDevice());
    Pass pass = graph.pass(kernel);
    for (int i = 0; i < 5; ++i) pass.read(scene);
    pass.readWrite(states).readWrite(paths).readWrite(vertices);
    pass.write(queries).write(weights).write(ends).readWrite(counters).write(results);
    pass.push(gpu::CacheTilesParams{t.width, t.height, t.tilesX, t.tilesY, frames, 5}).dispatch(items);
    graph.execute();
    const Quads records = download<glm::uvec4>(validatedDevice(), results, items);
    std::vector<std::vector<uint32_t>> found(frames);
    for (uint64_t i = 0; i < items; ++i) found[i / t.pixels()].push_back(records[i].x);
    return found;
}

// Frames in which some tile has another number of pixels than one, or a pixel trains another tile's path.
uint32_t wrongFrames(const Tiling& t, const std::vector<std::vector<uint32_t>>& frames) {
    uint32_t wrong = 0;
    for (const std::vector<uint32_t>& pixels : frames) {
        std::vector<uint32_t> ofTile(t.tiles(), 0);
        bool isRight = true;
        for (uint32_t p = 0; p < t.pixels(); ++p) {
            if (pixels[p] == 0) continue;
            isRight = isRight && pixels[p] - 1 == t.tileOf(p);
            ofTile[t.tileOf(p)]++;
        }
        for (const uint32_t count : ofTile) isRight = isRight && count == 1;
        wrong += !isRight;
    }
    return wrong;
}

// Whether the pixels of each tile were chosen equally often; all tiles fail together by chance once in a
// hundred times.
bool isUniform(const Tiling& t, const std::vector<std::vector<uint32_t>>& frames) {
    std::vector<std::vector<double>> chosen(t.tiles());
    for (uint32_t p = 0; p < t.pixels(); ++p) {
        double count = 0.0;
        for (const std::vector<uint32_t>& pixels : frames) count += pixels[p] != 0;
        chosen[t.tileOf(p)].push_back(count);
    }
    bool isSo = true;
    for (const std::vector<double>& counts : chosen) {
        const double each = double(frames.size()) / double(counts.size());
        const std::vector<double> expected(counts.size(), each);
        isSo = isSo &&
               reference::chiSquareTest(counts, expected).pValue > reference::sidakLevel(0.01, chosen.size());
    }
    return isSo;
}

constexpr uint32_t kFrames = 600; // at least 6 for each pixel of the largest tiles, of 100

} // namespace

TEST_CASE("one pixel of each tile trains in each frame, and all pixels of a tile equally often") {
    for (const Tiling& t : {Tiling{1, 1, 1, 1}, Tiling{7, 5, 1, 1}, Tiling{7, 5, 3, 2}, Tiling{7, 5, 7, 5},
                            Tiling{64, 48, 13, 7}, Tiling{64, 48, 9, 5}, Tiling{64, 48, 64, 47}}) {
        INFO(t.width << " x " << t.height << " in " << t.tilesX << " x " << t.tilesY << " tiles");
        const auto frames = trainingPixels(t, kFrames);
        CHECK(wrongFrames(t, frames) == 0);
        CHECK(isUniform(t, frames));
    }
    const auto none = trainingPixels({8, 8, 0, 0}, 2);
    CHECK(none == std::vector(2, std::vector<uint32_t>(64, 0)));
}

TEST_CASE("planted: a tile without pixel, one with two, and pixels that are preferred are found") {
    const Tiling t{64, 48, 13, 7};
    const auto frames = trainingPixels(t, kFrames);
    const auto pixelOf = [&](uint32_t frame, uint32_t path) {
        return static_cast<size_t>(std::find(frames[frame].begin(), frames[frame].end(), path + 1) -
                                   frames[frame].begin());
    };
    auto other = frames;
    other[5][pixelOf(5, 17)] = 0;
    CHECK(wrongFrames(t, other) == 1);
    other = frames;
    other[5][pixelOf(5, 17) == 0 ? 1 : 0] = 1;
    CHECK(wrongFrames(t, other) == 1);
    CHECK(wrongFrames({64, 48, 7, 13}, frames) == kFrames);
    other = frames; // in every fifth frame the first tile's choice is its first pixel
    for (uint32_t frame = 0; frame < kFrames; ++frame)
        if (frame % 5 == 0) std::swap(other[frame][0], other[frame][pixelOf(frame, 0)]);
    CHECK(wrongFrames(t, other) == 0);
    CHECK_FALSE(isUniform(t, other));
}

// ---- where paths ask and end ----

namespace {

constexpr uint32_t kPaths = 1000, kDepths = 12, kSample = 3, kSeed = 4;

Vec3 stored(const Vec3& v) {
    return Vec3(glm::vec3(v));
}

using Paths = std::vector<std::vector<CacheVertex>>;

CacheVertex randomVertex(Random& random) {
    const auto real = [&](double low, double high) {
        return double(static_cast<float>(low + (high - low) * random.uniform()));
    };
    const auto colour = [&](double low, double high) {
        return Vec3(real(low, high), real(low, high), real(low, high));
    };
    const auto unit = [&] { return stored(reference::direction(real(-1.0, 1.0), real(0.0, 2.0 * kPi))); };
    CacheVertex v;
    v.position = colour(-0.4, 10.4); // one in five outside the box
    v.view = unit();
    do v.geometricNormal = unit();
    while (glm::dot(v.geometricNormal, v.view) < 0.02);
    v.shadingNormal = unit();
    v.distance = real(0.2, 2.0);
    v.pdf = double(static_cast<float>(std::exp2(real(-4.0, 4.0))));
    v.roughness = real(0.0, 1.0);
    v.isDelta = random.uniform() < 0.15;
    v.diffuse = v.isDelta ? Vec3(0.0) : colour(0.0, 1.0);
    v.specular = colour(0.0, 1.0);
    v.throughput = colour(0.1, 1.3);
    v.light = random.uniform() < 0.7 ? colour(0.0, 2.0) : Vec3(0.0);
    v.emission = random.uniform() < 0.3 ? colour(0.0, 2.0) : Vec3(0.0);
    v.goesOn = random.uniform() < 0.9;
    return v;
}

Paths randomPaths() {
    Random random(1);
    Paths paths(kPaths);
    for (std::vector<CacheVertex>& path : paths)
        for (uint32_t v = 0; v < kDepths; ++v) path.push_back(randomVertex(random));
    return paths;
}

Quads packVertices(const Paths& paths) {
    Quads records;
    const auto add = [&](const Vec3& v, double w) {
        records.push_back(quad(v, std::bit_cast<uint32_t>(static_cast<float>(w))));
    };
    for (const std::vector<CacheVertex>& path : paths)
        for (const CacheVertex& v : path) {
            add(v.position, v.distance);
            add(v.view, v.pdf);
            add(v.geometricNormal, v.roughness);
            add(v.shadingNormal, double(v.isDelta ? gpu::kMinAlpha : 0.5f));
            records.push_back(quad(v.diffuse, v.goesOn));
            for (const Vec3& part : {v.specular, v.throughput, v.light, v.emission}) add(part, 0.0);
        }
    return records;
}

gpu::CacheRule toRule(const CacheSettings& s, float unbiasedShare) {
    gpu::CacheRule rule{};
    rule.boxLow = glm::vec4(glm::vec3(s.box.low), float(s.box.scale));
    rule.boxHigh = glm::vec4(glm::vec3(s.box.high), float(s.spread));
    rule.endDepth = s.endDepth;
    rule.lastDepth = s.lastDepth;
    rule.deepest = s.deepest;
    rule.tilesX = kPaths; // every path trains
    rule.tilesY = 1;
    rule.unbiasedShare = unbiasedShare;
    rule.residualShare = float(s.residualShare);
    rule.trainingSpread = float(s.trainingSpread);
    return rule;
}

struct Walks {
    std::vector<TrainingPath> training;
    std::map<uint32_t, reference::CacheQuery> queries; // by path
    uint32_t queryCount = 0;
};

Walks walkOnDevice(const Paths& paths, const gpu::CacheRule& rule) {
    static const Kernel kernel(validatedDevice(), kernels::cache_walk);
    const TrainingBuffers empty = packPaths(std::vector<TrainingPath>(kPaths));
    const size_t rows = empty.queries.size() / gpu::kCacheInputQuads;
    const Buffer scene = unused(), states = quadBuffer(Quads(rows)), training = quadBuffer(empty.paths),
                 vertices = quadBuffer(empty.vertices), queries = quadBuffer(empty.queries),
                 weights = quadBuffer(Quads(rows)), ends = quadBuffer(empty.queries),
                 counters = quadBuffer(Quads(gpu::kCacheCounters / 4)),
                 given = quadBuffer(packVertices(paths));
    struct Push {
        gpu::CacheRule rule;
        gpu::CacheWalkParams harness;
    };
    FrameGraph graph(validatedDevice());
    Pass pass = graph.pass(kernel);
    for (int i = 0; i < 5; ++i) pass.read(scene);
    pass.readWrite(states).readWrite(training).readWrite(vertices);
    pass.write(queries).write(weights).write(ends).readWrite(counters).read(given);
    pass.push(Push{rule, {kPaths, kDepths, kSample, kSeed, kPaths}}).dispatch(kPaths);
    graph.execute();
    const auto read = [](const Buffer& buffer) {
        return download<glm::uvec4>(validatedDevice(), buffer, buffer.bytes() / sizeof(glm::uvec4));
    };
    Walks walks;
    walks.training = unpackPaths({read(training), read(vertices), read(ends)}, kPaths);
    walks.queryCount = read(counters).front()[gpu::kQueryCounter];
    const Quads queryRecords = read(queries), weightRecords = read(weights);
    for (size_t row = 0; row < walks.queryCount; ++row)
        walks.queries[weightRecords.at(row).w] = {unpackInputs(queryRecords, row),
                                                  colour(weightRecords[row])};
    return walks;
}

// Random numbers of all paths, from the shaders' own generator.
std::vector<glm::uvec4> randomBits(uint32_t block) {
    static KernelHarness kernel(kernels::sampler_random_bits);
    return kernel.run({}, gpu::RngHarnessParams{{0, kSample, block, kSeed}, {1, 0, 0, 0}, kPaths}, kPaths,
                      kPaths);
}

double unitFloat(uint32_t bits) {
    return double(bits >> 8) * 0x1p-24;
}

// Of each path by the vertex at which it asks.
struct Choices {
    std::vector<bool> isUnbiased;
    std::vector<std::vector<bool>> goesPastQuery;
};

Choices choicesOf(double unbiasedShare, double residualShare) {
    Choices choices;
    choices.goesPastQuery.resize(kPaths);
    for (const glm::uvec4& bits : randomBits(0))
        choices.isUnbiased.push_back(unitFloat(bits.z) < unbiasedShare);
    for (uint32_t depth = 0; depth < kDepths; ++depth) {
        const auto bits = randomBits(3 + 3 * depth);
        for (uint32_t p = 0; p < kPaths; ++p)
            choices.goesPastQuery[p].push_back(unitFloat(bits[p].y) < residualShare);
    }
    return choices;
}

std::vector<CacheWalk> walkTwins(const Paths& paths, const CacheSettings& settings, const Choices& choices) {
    std::vector<CacheWalk> twins;
    for (uint32_t p = 0; p < kPaths; ++p) {
        const auto goesPast = [&](size_t query) { return choices.goesPastQuery[p].at(query); };
        twins.push_back(reference::walk(paths[p], settings, choices.isUnbiased[p], goesPast));
    }
    return twins;
}

// The driver's arc cosine is off by 1.6e-4 radians at most; all else by a few roundings of numbers up to 1.
constexpr double kPolarError = 1e-4, kInputError = 1e-6;
// Twelve vertices of a few products each, relative to the largest that is compared.
constexpr double kWalkRounding = 1e-5;

bool areClose(const Vec3& a, const Vec3& b) {
    const double size = std::max({reference::maxComponent(glm::abs(b)), 1.0});
    return reference::maxComponent(glm::abs(a - b)) <= kWalkRounding * size;
}
bool areClose(const Values& a, const Values& b) {
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= (i == 3 || i == 5 ? kPolarError : kInputError))) return false;
    return true;
}

bool areSame(const TrainingPath& a, const TrainingPath& b) {
    if (a.vertices.size() != b.vertices.size() || a.end.has_value() != b.end.has_value()) return false;
    for (size_t v = 0; v < a.vertices.size(); ++v) {
        const reference::TrainingVertex &x = a.vertices[v], &y = b.vertices[v];
        if (!areClose(x.inputs, y.inputs) || !areClose(x.gathered, y.gathered) ||
            !areClose(x.throughput, y.throughput))
            return false;
    }
    return !a.end || areClose(*a.end, *b.end);
}

struct Comparison {
    uint32_t wrongQueries = 0, wrongTraining = 0, uncertain = 0;
    uint32_t queries = 0, ends = 0;

    uint32_t wrong() const { return wrongQueries + wrongTraining; }
};

Comparison compare(const Walks& actual, const std::vector<CacheWalk>& twins) {
    Comparison result;
    for (uint32_t p = 0; p < kPaths; ++p) {
        const CacheWalk& twin = twins[p];
        if (twin.isUncertain) {
            result.uncertain++;
            continue;
        }
        const auto found = actual.queries.find(p);
        const bool asks = found != actual.queries.end();
        result.wrongQueries +=
            asks != twin.query.has_value() || (asks && (!areClose(found->second.inputs, twin.query->inputs) ||
                                                        !areClose(found->second.weight, twin.query->weight)));
        result.wrongTraining += !areSame(actual.training[p], twin.training);
        result.queries += asks;
        result.ends += twin.training.end.has_value();
    }
    if (actual.queryCount != actual.queries.size()) result.wrongQueries++; // a path has asked twice
    return result;
}

struct WalkCase {
    const char* name;
    double spread, trainingSpread;
    uint32_t endDepth, deepest, lastDepth;
    double unbiasedShare, residualShare;
};

constexpr uint32_t kNone = gpu::kNoDepth;
constexpr WalkCase kCases[] = {
    {"the paper's", 0.01, 0.01, kNone, 11, 11, 1.0 / 16.0, 0.0},
    {"longer paths", 30.0, 30.0, kNone, 11, 11, 0.25, 0.0},
    {"longer suffixes", 10.0, 100.0, kNone, 11, 20, 0.0, 0.0},
    {"unbiased suffixes", 10.0, 10.0, kNone, 11, 20, 1.0, 0.0},
    {"by depth", double(kNever), 30.0, 3, 11, 20, 0.0, 0.0},
    {"at once", -1.0, -1.0, kNone, 11, 20, 0.0, 0.0},
    {"never", double(kNever), double(kNever), kNone, 11, 20, 0.0, 0.0},
    {"rendering ends first", 1000.0, 50.0, kNone, 4, 20, 0.0, 0.0},
    {"training ends first", 100.0, 100.0, kNone, 11, 2, 0.0, 0.0},
    {"residual", 30.0, 30.0, kNone, 11, 11, 0.25, 0.5},
};

CacheSettings settingsOf(const WalkCase& c) {
    CacheSettings settings;
    settings.box = {Vec3(0.0), Vec3(10.0), double(0.1f)};
    settings.spread = c.spread;
    settings.trainingSpread = c.trainingSpread;
    settings.endDepth = c.endDepth;
    settings.deepest = c.deepest;
    settings.lastDepth = c.lastDepth;
    settings.residualShare = c.residualShare;
    return settings;
}

} // namespace

TEST_CASE("paths ask, end and record as the twin does") {
    const Paths paths = randomPaths();
    for (const WalkCase& c : kCases) {
        const Walks actual = walkOnDevice(paths, toRule(settingsOf(c), float(c.unbiasedShare)));
        const Comparison result =
            compare(actual, walkTwins(paths, settingsOf(c), choicesOf(c.unbiasedShare, c.residualShare)));
        INFO(c.name << ": " << result.queries << " queries, " << result.ends << " ends, " << result.uncertain
                    << " uncertain");
        CHECK(result.wrongQueries == 0);
        CHECK(result.wrongTraining == 0);
        CHECK(result.uncertain < kPaths / 100);
    }
}

TEST_CASE("planted: walks by another rule are found") {
    const Paths paths = randomPaths();
    const WalkCase& c = kCases[9]; // all of it
    const CacheSettings settings = settingsOf(c);
    const Choices choices = choicesOf(c.unbiasedShare, c.residualShare);
    const Walks actual = walkOnDevice(paths, toRule(settings, float(c.unbiasedShare)));
    REQUIRE(compare(actual, walkTwins(paths, settings, choices)).wrong() == 0);

    const auto isFound = [&](const auto& change) {
        Paths other = paths;
        CacheSettings otherSettings = settings;
        for (auto& path : other)
            for (size_t v = 0; v < path.size(); ++v) change(path[v], otherSettings, v);
        return compare(actual, walkTwins(other, otherSettings, choices)).wrong() > kPaths / 100;
    };
    CHECK(isFound([](CacheVertex&, CacheSettings& s, size_t) { s.spread = 60.0; })); // a0 over 2 pi
    CHECK(isFound([](CacheVertex&, CacheSettings& s, size_t) { s.trainingSpread = 60.0; }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { v.geometricNormal = v.view; })); // no cosine
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { v.geometricNormal = v.shadingNormal; }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { v.pdf = 1.0; }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { v.isDelta = false; }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t i) {
        if (i == 0) v.light = Vec3(0.0);
    }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { v.emission = Vec3(0.0); }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { v.throughput.z = v.throughput.x; }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { std::swap(v.view, v.shadingNormal); }));
    CHECK(isFound([](CacheVertex& v, CacheSettings&, size_t) { std::swap(v.diffuse, v.specular); }));
    CHECK(isFound([](CacheVertex&, CacheSettings& s, size_t) { s.box.high.x = 9.0; }));
    CHECK(isFound([](CacheVertex&, CacheSettings& s, size_t) { s.residualShare = 0.55; }));
    CHECK(isFound([](CacheVertex&, CacheSettings& s, size_t) { s.lastDepth = 9; }));
    Choices other = choices;
    other.isUnbiased.assign(kPaths, false);
    CHECK(compare(actual, walkTwins(paths, settings, other)).wrong() > kPaths / 100);
}

// ---- inputs ----

namespace {

bool isInUnitCube(const Values& inputs) {
    return std::all_of(inputs.begin(), inputs.end(), [](double x) { return x >= 0.0 && x <= 1.0; });
}

} // namespace

TEST_CASE("spherical coordinates stay in the unit square, at poles and seams too") {
    std::vector<Vec3> directions;
    for (const double x : {-1.0, -1e-7, -0.0, 0.0, 1e-7, 1.0})
        for (const double y : {-1.0, -1e-30, -1e-7, -0.0, 0.0, 1e-7, 1.0})
            for (const double z : {-1.0, -1e-7, 0.0, 1e-7, 1.0})
                if (x * x + y * y + z * z > 0.5) directions.push_back(stored(glm::normalize(Vec3(x, y, z))));
    directions.emplace_back(stored({0.0, 0.0, 1.0000001})); // as long as rounding makes it
    directions.emplace_back(stored({0.0, 0.0, -1.0000001}));
    REQUIRE(directions.size() <= kPaths);
    Paths paths = randomPaths();
    for (size_t p = 0; p < kPaths; ++p) {
        CacheVertex& v = paths[p].front();
        v.view = v.geometricNormal = directions[p % directions.size()];
        v.shadingNormal = directions[(p + 1) % directions.size()];
        v.position = glm::clamp(v.position, Vec3(0.0), Vec3(10.0));
        v.isDelta = false;
    }
    const Walks walks = walkOnDevice(paths, toRule(settingsOf(kCases[5]), 0.0f)); // all ask at once
    REQUIRE(walks.queries.size() == kPaths);
    double worstPolar = 0.0, worstAzimuth = 0.0;
    for (size_t p = 0; p < directions.size(); ++p) {
        const Values& inputs = walks.queries.at(static_cast<uint32_t>(p)).inputs;
        INFO(directions[p].x << ' ' << directions[p].y << ' ' << directions[p].z << ": " << inputs[3] << ' '
                             << inputs[4]);
        CHECK(isInUnitCube(inputs));
        const reference::Vec2 expected = reference::sphericalCoordinates(directions[p]);
        const double turn = std::abs(inputs[4] - expected.y);
        worstPolar = std::max(worstPolar, std::abs(inputs[3] - expected.x));
        // At the poles there is no azimuth; at the seam it is 0 or 1.
        const double sine = std::hypot(directions[p].x, directions[p].y);
        if (sine > 1e-6) worstAzimuth = std::max(worstAzimuth, std::min(turn, 1.0 - turn));
    }
    CHECK(worstPolar <= kPolarError);
    CHECK(worstAzimuth <= kInputError);
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
