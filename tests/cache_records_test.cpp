// From training vertices to records: their places, the targets' brightness and the scale, inputs and
// targets against twins in double precision; and that bad radiance leaves no trace in the cache.
#include "kernels/cache.h"
#include "kernels/shaders.h"
#include "nrc/cache/neural_cache.h"
#include "nrc/learning/model_file.h"
#include "nrc/renderer/nrc_config.h"
#include "shared/network.h"
#include "tests/shaders/harness.h"
#include "tests/support/cache_bench.h"
#include "tests/support/expect_error.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/temporary_folder.h"
#include <algorithm>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <numeric>

using namespace irradia;
using namespace irradia::test;
using reference::Random;
using reference::TrainingPath;
using reference::Values;
using reference::Vec3;

namespace {

QuadAccess eachForm() {
    return GENERATE(QuadAccess::Texel, QuadAccess::Storage);
}

} // namespace

// ---- counting and brightness ----

namespace {

struct PathSum {
    uint32_t records = 0;
    float rootSum = 0.0f, largest = 0.0f;
};

std::vector<PathSum> randomSums(Random& random, size_t count, double brightness) {
    std::vector<PathSum> sums(count);
    for (PathSum& s : sums) {
        s.records = static_cast<uint32_t>(random.uniform() * (reference::kMaxRecorded + 1));
        s.rootSum = static_cast<float>(s.records * std::sqrt(brightness * (0.5 + random.uniform())));
        s.largest = s.rootSum;
    }
    return sums;
}

Quads packSums(const std::vector<PathSum>& sums) {
    Quads records(std::max<size_t>(sums.size(), 1));
    for (size_t i = 0; i < sums.size(); ++i)
        records[i] = {sums[i].records, std::bit_cast<uint32_t>(sums[i].rootSum),
                      std::bit_cast<uint32_t>(sums[i].largest), 0};
    return records;
}

class Counting {
public:
    explicit Counting(QuadAccess form)
        : bench(form)
        , kernel(bench.kernel(kernels::count_records)) {}

    // First record of each path.
    std::vector<uint32_t> run(const std::vector<PathSum>& sums, uint32_t capacity, float decay = 0.9f) {
        const auto paths = static_cast<uint32_t>(sums.size());
        const Buffer input = bench.make(packSums(sums)),
                     first(bench.device, "first records", std::max(paths, 1u) * 4);
        FrameGraph graph(bench.device);
        graph.pass(kernel)
            .readWrite(bench.counters)
            .read(input)
            .write(first)
            .readWrite(bench.state)
            .push(gpu::RecordsParams{paths, capacity, 0, decay})
            .dispatchGroups(1);
        graph.execute();
        return download<uint32_t>(bench.device, first, paths);
    }

    CacheBench bench;
    const Kernel& kernel;
};

double sumOf(const std::vector<PathSum>& sums) {
    return std::accumulate(sums.begin(), sums.end(), 0.0,
                           [](double sum, const PathSum& s) { return sum + double(s.rootSum); });
}
uint32_t recordsOf(const std::vector<PathSum>& sums) {
    return std::accumulate(sums.begin(), sums.end(), 0u,
                           [](uint32_t sum, const PathSum& s) { return sum + s.records; });
}
double largestOf(const std::vector<PathSum>& sums) {
    float largest = 0.0f;
    for (const PathSum& s : sums) largest = std::max(largest, s.largest);
    return double(largest);
}

std::vector<uint32_t> firstRecordsOf(const std::vector<PathSum>& sums) {
    std::vector<uint32_t> first;
    uint32_t total = 0;
    for (const PathSum& s : sums) {
        first.push_back(total);
        total += s.records;
    }
    return first;
}

// Each lane adds its share of the paths, and the first one what the lanes have found.
float sumInFixedOrder(const std::vector<PathSum>& sums, size_t lanes) {
    const size_t share = (sums.size() + lanes - 1) / lanes;
    float total = 0.0f;
    for (size_t lane = 0; lane < lanes; ++lane) {
        float sum = 0.0f;
        for (size_t p = lane * share; p < std::min((lane + 1) * share, sums.size()); ++p)
            sum += sums[p].rootSum;
        total += sum;
    }
    return total;
}

} // namespace

TEST_CASE("each path gets its place among the records, and what has no room is counted") {
    const QuadAccess form = eachForm();
    Counting counting(form);
    for (const size_t paths : {0, 1, 31, 32, 33, 1000}) {
        Random random(paths + 1);
        const std::vector<PathSum> sums = randomSums(random, paths, 1.0);
        const uint32_t total = recordsOf(sums);
        for (const uint32_t capacity : {total + 7, total, total / 2, 0u}) {
            INFO(paths << " paths, " << total << " records, capacity " << capacity);
            const bool isPlaced = counting.run(sums, capacity) == firstRecordsOf(sums);
            CHECK(isPlaced);
            CHECK(counting.bench.counter(gpu::kRecordCounter) == std::min(total, capacity));
            CHECK(counting.bench.counter(gpu::kSkippedRecords) == total - std::min(total, capacity));
        }
    }
}

TEST_CASE("sums over paths are taken in an order that depends on nothing else") {
    const QuadAccess form = eachForm();
    Counting counting(form);
    Random random(7);
    std::vector<PathSum> sums = randomSums(random, 1024, 1.0);
    for (PathSum& s : sums) s.records = 4; // 4096 together: division by them is exact
    sums[500].rootSum = 3e5f;              // and takes bits from those that are added later
    const size_t lanes = counting.kernel.workgroupSize();
    const auto brightness = [&](size_t adding) {
        const float root = sumInFixedOrder(sums, adding) / 4096.0f;
        return root * root;
    };
    const float expected = brightness(lanes);
    for (int run = 0; run < 3; ++run) {
        counting.run(sums, 10000);
        CHECK(counting.bench.readState().frameBrightness == expected);
    }
    CHECK(brightness(1) != expected); // planted: another order
    CHECK(brightness(2 * lanes) != expected);
}

TEST_CASE("the running mean of brightness and the scale follow the scene's brightness") {
    const QuadAccess form = eachForm();
    Counting counting(form);
    reference::Brightness twin;
    Random random(9);
    double brightness = 0.05;
    uint32_t moves = 0, stays = 0;
    for (int frame = 0; frame < 120; ++frame) {
        brightness *= std::exp2(3.0 * random.uniform() - (frame < 60 ? 1.2 : 1.8));
        const std::vector<PathSum> sums = randomSums(random, frame % 7 == 3 ? 0 : 40, brightness);
        const double before = twin.scale;
        counting.run(sums, 1000);
        twin.addFrame(recordsOf(sums), sumOf(sums), largestOf(sums), double(0.9f));
        const gpu::CacheState state = counting.bench.readState();
        INFO("frame " << frame << ", brightness " << twin.brightness);
        // The mean's own rounding, 120 times; the power of two is exact.
        REQUIRE(std::abs(double(state.brightness) / twin.brightness - 1.0) < 1e-5);
        REQUIRE(std::abs(double(state.frameBrightness) / twin.frameBrightness - 1.0) < 1e-5);
        REQUIRE(double(state.largestTarget) == twin.largest);
        REQUIRE(state.frames == twin.frames);
        REQUIRE(double(state.scale) == twin.scale);
        REQUIRE(double(state.rescaling) == twin.rescaling);
        const double scaled = twin.brightness * twin.scale;
        REQUIRE((scaled > 0.249 && scaled < 4.01));
        (before == twin.scale ? stays : moves)++;
    }
    CHECK(moves >= 5);
    CHECK(stays >= 60);
}

TEST_CASE("the scale stays from a quarter to four, and moves beyond") {
    Counting counting(QuadAccess::Texel);
    const auto scaleAfter = [&](float brightness) {
        counting.bench.set(stateOf(1.0));
        counting.run({{1, std::sqrt(brightness), brightness}}, 10);
        return counting.bench.readState().scale;
    };
    for (const float brightness : {0.25f, 1.0f, 4.0f}) CHECK(scaleAfter(brightness) == 1.0f);
    CHECK(scaleAfter(0.249f) == 4.0f);
    CHECK(scaleAfter(4.01f) == 0.25f);
    CHECK(scaleAfter(1e-10f) == std::exp2(33.0f));
    CHECK(scaleAfter(1e10f) == std::exp2(-33.0f));
    for (const float useless : {0.0f, 1e-30f, INFINITY, NAN}) CHECK(scaleAfter(useless) == 1.0f);
}

TEST_CASE("a frame without records leaves the mean and the scale as they are") {
    Counting counting(QuadAccess::Texel);
    Random random(11);
    counting.run(randomSums(random, 50, 20.0), 1000);
    const gpu::CacheState before = counting.bench.readState();
    REQUIRE(before.scale != 1.0f);
    for (const size_t paths : {size_t{0}, size_t{50}}) {
        counting.run(std::vector<PathSum>(paths), 1000);
        const gpu::CacheState after = counting.bench.readState();
        CHECK(after.scale == before.scale);
        CHECK(after.brightness == before.brightness);
        CHECK(after.frames == before.frames);
        CHECK(after.largestTarget == 0.0f); // of the last frame
        CHECK(counting.bench.counter(gpu::kRecordCounter) == 0);
    }
}

TEST_CASE("with the scale the last layer changes, so that predictions keep their meaning") {
    const QuadAccess form = eachForm();
    CacheBench bench(form);
    Random random(13);
    std::vector<float> before(256);
    for (float& w : before) w = static_cast<float>(2.0 * random.uniform() - 1.0);
    for (const float rescaling : {1.0f, 8.0f, 0.0625f}) {
        const Buffer values = makeBuffer(bench.device, "values", before),
                     averages = makeBuffer(bench.device, "averages", before);
        gpu::CacheState state = stateOf(4.0);
        state.rescaling = rescaling;
        bench.set(state);
        FrameGraph graph(bench.device);
        graph.pass(bench.kernel(kernels::rescale_outputs))
            .read(bench.state)
            .readWrite(values)
            .readWrite(averages)
            .push(gpu::RescaleParams{60}) // of 64
            .dispatch(64);
        graph.execute();
        std::vector<float> expected = before;
        for (size_t i = 0; i < 240; ++i) expected[i] *= rescaling;
        CHECK(download<float>(bench.device, values, 256) == expected);
        CHECK(download<float>(bench.device, averages, 256) == expected);
    }
}

// ---- records ----

namespace {

using WrittenRecord = std::optional<std::pair<Values, Vec3>>; // nothing where the row is untouched

const glm::uvec4 kUntouched(0x7fc12345u);

// Of `rows` rows of the buffers, those that are written; `places` is what the kernel is told.
std::vector<WrittenRecord> write(QuadAccess form, const std::vector<TrainingPath>& paths,
                                 const std::vector<PathSum>& places, uint32_t capacity, bool factorise,
                                 double scale, size_t rows) {
    CacheBench bench(form);
    bench.set(stateOf(scale));
    const uint32_t total = recordsOf(places), kept = std::min(total, capacity);
    bench.set(gpu::kRecordCounter, kept);
    bench.set(gpu::kSkippedRecords, total - kept);
    const std::vector<uint32_t> first = firstRecordsOf(places);
    const Buffer sums = bench.make(packSums(places)), firstRecords = makeBuffer(bench.device, "first", first),
                 vertices = bench.make(packPaths(paths).vertices),
                 inputs = bench.make(Quads(rows * gpu::kCacheInputQuads, kUntouched)),
                 targets = bench.make(Quads(rows, kUntouched));
    const Kernel& kernel = bench.kernel(kernels::write_records);
    const auto count = static_cast<uint32_t>(paths.size());
    FrameGraph graph(bench.device);
    graph.pass(kernel)
        .readWrite(bench.counters)
        .read(sums)
        .read(firstRecords)
        .read(vertices)
        .read(bench.state)
        .write(inputs)
        .write(targets)
        .push(gpu::RecordsParams{count, capacity, factorise ? 1u : 0u, 0.0f})
        .dispatch(uint64_t{count} * gpu::kMaxTrainingVertices);
    graph.execute();
    const Quads inputRecords = download<glm::uvec4>(bench.device, inputs, rows * gpu::kCacheInputQuads);
    const Quads targetRecords = download<glm::uvec4>(bench.device, targets, rows);
    std::vector<WrittenRecord> result(rows);
    for (size_t row = 0; row < rows; ++row) {
        bool isUntouched = targetRecords[row] == kUntouched;
        for (uint32_t q = 0; q < gpu::kCacheInputQuads; ++q)
            isUntouched = isUntouched &&
                          inputRecords[gpu::quadIndex(uint32_t(row), q, gpu::kCacheInputQuads)] == kUntouched;
        if (!isUntouched) result[row].emplace(unpackInputs(inputRecords, row), colour(targetRecords[row]));
    }
    return result;
}

std::vector<PathSum> placesOf(const std::vector<TrainingPath>& paths) {
    std::vector<PathSum> places(paths.size());
    for (size_t p = 0; p < paths.size(); ++p)
        places[p].records = static_cast<uint32_t>(paths[p].vertices.size());
    return places;
}

// Rows that are not what they should be.
size_t wrongRows(const std::vector<WrittenRecord>& written, const std::vector<TrainingPath>& paths,
                 uint32_t capacity, bool factorise, double scale) {
    const uint32_t total = recordsOf(placesOf(paths));
    size_t wrong = 0, row = 0, record = 0;
    for (const TrainingPath& path : paths)
        for (const reference::TrainingVertex& v : path.vertices) {
            const auto place = reference::evenPlace(record++, std::min(total, capacity), total);
            if (!place) continue;
            wrong += *place != row;
            const Vec3 factor = factorise ? reference::reflectance(v.inputs) : Vec3(1.0);
            const Vec3 target = reference::toTarget(v.gathered, factor, scale);
            const auto& actual = written.at(row++);
            const double size = std::max(reference::maxComponent(target), 1e-3);
            wrong +=
                !actual || actual->first != v.inputs || difference(actual->second, target, size) > kRounding;
        }
    for (; row < written.size(); ++row) wrong += written[row].has_value();
    return wrong;
}

} // namespace

TEST_CASE("records hold each training vertex once, its target demodulated and scaled") {
    const QuadAccess form = eachForm();
    for (const size_t count : {1, 33, 200}) {
        Random random(count + 20);
        const std::vector<TrainingPath> paths = randomPaths(random, count);
        const std::vector<PathSum> places = placesOf(paths);
        const uint32_t total = recordsOf(places);
        for (const bool factorise : {false, true})
            for (const uint32_t capacity : {total + 300, total, total - total / 3, 0u}) {
                INFO(count << " paths, factorise " << factorise << ", capacity " << capacity << " of "
                           << total);
                const auto written = write(form, paths, places, capacity, factorise, 4.0, 2048);
                CHECK(wrongRows(written, paths, capacity, factorise, 4.0) == 0);
            }
    }
}

// In every stretch of records as many are left out as its share, to within one.
TEST_CASE("what is beyond the capacity is left out evenly") {
    const auto worst = [](const std::vector<bool>& isKept, uint32_t kept) {
        const auto n = static_cast<double>(isKept.size());
        double sum = 0.0, largest = 0.0;
        for (size_t k = 0; k < isKept.size(); ++k) {
            sum += isKept[k];
            largest = std::max(largest, std::abs(sum - double(k + 1) * kept / n));
        }
        return largest;
    };
    Random random(17);
    const std::vector<TrainingPath> paths = randomPaths(random, 300);
    const uint32_t total = recordsOf(placesOf(paths));
    for (const uint32_t capacity : {1u, total / 3, total / 2, total - 1}) {
        INFO(capacity << " of " << total);
        const auto written = write(QuadAccess::Texel, paths, placesOf(paths), capacity, false, 1.0, 2048);
        CHECK(wrongRows(written, paths, capacity, false, 1.0) == 0);
        // Inputs are random: each row tells which vertex it is.
        std::vector<bool> isKept;
        size_t row = 0;
        for (const TrainingPath& path : paths)
            for (const reference::TrainingVertex& v : path.vertices) {
                isKept.push_back(written[row] && written[row]->first == v.inputs);
                row += isKept.back();
            }
        CHECK(row == capacity);
        CHECK(worst(isKept, capacity) <= 1.0);
        // Planted: the last ones left out.
        std::vector<bool> first(total, false);
        std::fill_n(first.begin(), capacity, true);
        if (capacity > 1 && capacity < total - 1) CHECK(worst(first, capacity) > 0.1 * total);
    }
}

TEST_CASE("places among the kept are exact for products beyond 32 bits") {
    test::KernelHarness kernel(kernels::even_place);
    Random random(18);
    Quads things;
    for (int i = 0; i < 4096; ++i) {
        const auto below = [&](double most) { return static_cast<uint32_t>(random.uniform() * most); };
        const uint32_t n = 1 + below(std::exp2(31.0 * random.uniform()));
        things.emplace_back(below(n), below(n + 1.0), n, 0);
    }
    things.emplace_back(0x7ffffffeu, 0x7fffffffu, 0x7fffffffu, 0);
    things.emplace_back(0x7ffffffeu, 0x7ffffffeu, 0x7fffffffu, 0);
    const Buffer input = quadBuffer(things);
    const auto count = static_cast<uint32_t>(things.size());
    const Quads results = kernel.run({input}, gpu::CountParams{count}, count, count);
    size_t wrong = 0;
    for (size_t i = 0; i < things.size(); ++i) {
        const uint64_t k = things[i].x, kept = things[i].y, n = things[i].z;
        wrong += results[i].x != k * kept / n;
        wrong += (results[i].y == 1) != reference::evenPlace(k, kept, n).has_value();
    }
    CHECK(wrong == 0);
}

TEST_CASE("channels of next to no reflectance have nothing to learn, whatever was gathered") {
    TrainingPath path;
    for (const double bad : {1.0, double(NAN), kInfinity}) {
        Values inputs(gpu::kCacheInputs, 0.25);
        inputs[8] = inputs[11] = stored(0.0004);      // 0.0008 together
        inputs[9] = 0.0, inputs[12] = stored(0.0011); // learned
        path.vertices.push_back({inputs, {bad, 1.0, 1.0}, Vec3(0.0)});
    }
    const auto written = write(QuadAccess::Texel, {path}, placesOf({path}), 8, true, 1.0, 16);
    for (size_t row = 0; row < 3; ++row) {
        REQUIRE(written[row]);
        CHECK(written[row]->second.x == 0.0);
        CHECK(std::abs(written[row]->second.y * 0.0011 - 1.0) < kRounding);
        CHECK(std::abs(written[row]->second.z * 0.5 - 1.0) < kRounding);
    }
}

TEST_CASE("planted: records that are exchanged, not demodulated, not scaled, or beyond capacity are found") {
    Random random(31);
    const std::vector<TrainingPath> paths = randomPaths(random, 40);
    const uint32_t total = recordsOf(placesOf(paths));
    const auto written = write(QuadAccess::Texel, paths, placesOf(paths), total, true, 2.0, 512);
    REQUIRE(wrongRows(written, paths, total, true, 2.0) == 0);
    CHECK(wrongRows(written, paths, total, false, 2.0) > total / 2);
    CHECK(wrongRows(written, paths, total, true, 1.0) > total / 2);
    CHECK(wrongRows(written, paths, total - 1, true, 2.0) > 0);
    std::vector<TrainingPath> other = paths;
    auto& vertices = std::find_if(other.begin(), other.end(), [](const TrainingPath& p) {
                         return p.vertices.size() > 4;
                     })->vertices;
    std::swap(vertices[1], vertices[2]);
    CHECK(wrongRows(written, other, total, true, 2.0) == 2);
}

// ---- the cache as a whole ----

namespace {

NeuralCacheOptions smallCache() {
    NeuralCacheOptions options;
    options.model = nrcPreset("fast").model;
    options.steps = 2;
    return options;
}
constexpr CacheRoom kRoom{256, 256, 1024};

// A frame whose training paths are given.
void learn(Device& device, NeuralCache& cache, const std::vector<TrainingPath>& paths) {
    FrameGraph graph(device);
    cache.begin(graph);
    graph.execute();
    const TrainingBuffers packed = packPaths(paths);
    upload<glm::uvec4>(device, *cache.buffers().trainingPaths.buffer, packed.paths);
    upload<glm::uvec4>(device, *cache.buffers().trainingVertices.buffer, packed.vertices);
    upload<glm::uvec4>(device, *cache.buffers().trainingQueries.buffer, packed.queries);
    cache.learn(graph, static_cast<uint32_t>(paths.size()));
    graph.execute();
}

bool isFinite(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

} // namespace

TEST_CASE("bad radiance in training vertices is dropped and counted, and everything stays finite") {
    Device& device = deviceWith(QuadAccess::Texel);
    NeuralCache cache(device, smallCache(), kRoom);
    Random random(41);
    uint32_t dropped = 0, records = 0;
    for (int frame = 0; frame < 6; ++frame) {
        std::vector<TrainingPath> paths = randomPaths(random, 200);
        for (size_t p = 0; p < paths.size(); ++p) {
            TrainingPath& path = paths[p];
            path.end.reset(); // targets are then known without the network
            for (reference::TrainingVertex& v : path.vertices)
                for (size_t c = 8; c < 14; ++c) v.inputs[c] = std::max(v.inputs[c], 0.125);
            if (p % 10 == 0 && !path.vertices.empty()) {
                const size_t kind = p / 10 % 4;
                path.vertices[path.vertices.size() / 2].gathered[static_cast<int>(kind % 3)] =
                    kBadRadiance[kind];
            }
            for (const Vec3& t : reference::targets(path, Vec3(0.0))) {
                ++records;
                // The trainer's limit is 1e8; a 1e30 that light takes on its way stays far beyond it.
                dropped += !(reference::maxComponent(glm::abs(t)) < 1e8) || std::isnan(t.x + t.y + t.z);
            }
        }
        learn(device, cache, paths);
        const CacheCounts counts = cache.counts();
        INFO("frame " << frame);
        CHECK(counts.training.droppedRecords == dropped);
        CHECK(counts.training.damagedParameters == 0);
        CHECK(counts.training.steps == 2u * (frame + 1));
        CHECK(std::isfinite(counts.training.loss));
        CHECK(isFinite(cache.trainer().parameters(Weights::Raw)));
        CHECK(isFinite(cache.trainer().parameters(Weights::Ema)));
        CHECK((counts.state.brightness > 0.1f && counts.state.brightness < 20.0f));
        CHECK((counts.state.scale >= 0.125f && counts.state.scale <= 4.0f));
    }
    CHECK(dropped >= 50);
    CHECK(dropped < records / 4);
}

namespace {

// What is added to the radiance of a path for each of these queries, of weight 1.
std::vector<glm::vec4> answersOf(Device& device, NeuralCache& cache, const std::vector<Values>& queries) {
    Quads weights;
    for (uint32_t i = 0; i < queries.size(); ++i) weights.push_back(quad(Vec3(1.0), i));
    const CacheBuffers buffers = cache.buffers();
    upload<glm::uvec4>(device, *buffers.queries.buffer, packInputs(queries));
    upload<glm::uvec4>(device, *buffers.queryWeights.buffer, weights);
    upload<uint32_t>(device, *buffers.counters.buffer, std::vector{static_cast<uint32_t>(queries.size())},
                     gpu::kQueryCounter * 4);
    const Buffer radiance(device, "radiance", queries.size() * 16);
    FrameGraph graph(device);
    cache.answer(graph, radiance);
    graph.execute();
    return download<glm::vec4>(device, radiance, queries.size());
}

} // namespace

TEST_CASE("a cache that was saved and loaded predicts the same radiance, at whatever scale") {
    Device& device = deviceWith(QuadAccess::Texel);
    const TemporaryFolder folder;
    const auto file = folder / "room.cache";
    Random random(43);
    NeuralCache cache(device, smallCache(), kRoom);
    for (int frame = 0; frame < 4; ++frame) {
        std::vector<TrainingPath> paths = randomPaths(random, 200);
        for (TrainingPath& path : paths)
            for (reference::TrainingVertex& v : path.vertices) v.gathered *= 1000.0;
        learn(device, cache, paths);
    }
    REQUIRE(cache.counts().state.scale < 0.1f);
    std::vector<Values> queries;
    for (int i = 0; i < 100; ++i) queries.push_back(randomInputs(random));
    const std::vector<glm::vec4> expected = answersOf(device, cache, queries);
    cache.save(file);

    NeuralCache loaded(device, smallCache(), kRoom);
    CHECK(answersOf(device, loaded, queries) != expected); // planted: it has learned nothing
    loaded.load(file);
    CHECK(answersOf(device, loaded, queries) == expected);
    CHECK(loaded.counts().state.brightness == cache.counts().state.brightness);
    // Planted: the trainer alone, without the scale of its outputs.
    NeuralCache unscaled(device, smallCache(), kRoom);
    unscaled.trainer().load(ModelFile::read(file, "cache"));
    CHECK(answersOf(device, unscaled, queries) != expected);

    NeuralCacheOptions other = smallCache();
    other.factorise = false;
    NeuralCache whole(device, other, kRoom);
    expectError(ExitCode::BadData, "radiance over reflectance", [&] { whole.load(file); });
}

TEST_CASE("the device has nothing to say against it") {
    for (const QuadAccess form : {QuadAccess::Texel, QuadAccess::Storage})
        CHECK(deviceWith(form).validationMessages() == 0);
}
