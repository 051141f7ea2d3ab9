// irradia bench encodings: the radiance cache's inputs with one encoding or another, in interleaved rounds.
#include "bench_tools.h"
#include "commands.h"
#include "nrc/learning/encoding.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/outputs.h"
#include "samples/support/standard_streams.h"
#include "shared/network.h"
#include <algorithm>
#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>
#include <random>

namespace irradia {
namespace {

struct BenchEncodingsOptions {
    uint32_t rows = 1u << 16;
    uint32_t rounds = 25;
    std::string precision = "float";
    std::string json;
    DeviceOptions device;
};

// Position 3; direction 2, normal 2, roughness 1; diffuse and specular reflectance 6 (Müller et al. 2021,
// table 1).
constexpr uint32_t kInputs = 14;

struct Composite {
    std::string name;
    EncodingConfig position;
    bool gaussian = false;
};

EncodingConfig waves(const char* otype, double frequencies) {
    return makeEncoding(otype, 3, {{"n_frequencies", frequencies}});
}

EncodingConfig hashGrid(double log2Size) {
    return makeEncoding("HashGrid", 3, {{"log2_hashmap_size", log2Size}});
}

// The first is what the others are compared with.
std::vector<Composite> composites() {
    const EncodingConfig triangle = waves("TriangleWave", 12);
    const EncodingConfig sine = waves("Frequency", 6); // and cosine: as many values
    return {{"triangle wave, quartic", triangle},
            {"triangle wave, Gaussian", triangle, true},
            {"sine and cosine, quartic", sine},
            {"sine and cosine, Gaussian", sine, true},
            {"12 octaves of these, quartic", waves("Frequency", 12)},
            {"hash grid 8x2 2^15, quartic", hashGrid(15)},
            {"hash grid 8x2 2^19, quartic", hashGrid(19)}};
}

std::vector<EncodingConfig> partsOf(const Composite& composite) {
    return {composite.position, makeEncoding("OneBlob", 5, {{"kernel", composite.gaussian}}),
            makeEncoding("Identity")};
}

class EncodingRun {
public:
    EncodingRun(Device& device, Composite composite, Precision precision, const Buffer& inputs,
                const Buffer& counters, uint32_t capacity)
        : composite_(std::move(composite))
        , encoding_(device, partsOf(composite_), kInputs, precision)
        , inputs_(inputs)
        , rows_{counters, 0, capacity}
        , features_(device, "features", std::max<uint64_t>(encoding_.featureCount(), 4) * sizeof(float))
        , encoded_(device, "encoded", uint64_t(capacity) * encoding_.width() * sizeof(float))
        , graph_(device, &profiler_) {}

    // Seconds by the device's clock, or by the wall's where it has none.
    double run() {
        encoding_.encode(graph_, rows_, inputs_, features_, encoded_);
        const auto start = std::chrono::steady_clock::now();
        graph_.execute();
        const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        profiler_.endFrame(1e3 * wall);
        double passes = 0;
        for (const Profiler::Row& row : profiler_.rows()) passes += 1e-3 * profiler_.lastFrame(row.name);
        return passes > 0 ? passes : wall;
    }

    const std::string& name() const { return composite_.name; }
    uint32_t width() const { return encoding_.width(); }
    Profiler& profiler() { return profiler_; }

    std::vector<double> seconds, ratios; // by round

private:
    Composite composite_;
    Encoding encoding_;
    const Buffer& inputs_;
    RowCount rows_;
    Buffer features_, encoded_;
    Profiler profiler_;
    FrameGraph graph_;
};

Buffer uniformInputs(Device& device, uint32_t capacity) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<float> values(size_t(capacity) * 4 * ((kInputs + 3) / 4));
    std::ranges::generate(values, [&] { return unit(random); });
    return makeBuffer(device, "inputs", values);
}

nlohmann::ordered_json toJson(std::deque<EncodingRun>& runs, const BenchEncodingsOptions& options,
                              const Device& device) {
    nlohmann::ordered_json json;
    for (EncodingRun& run : runs) {
        const double seconds = median(run.seconds);
        nlohmann::ordered_json passes;
        for (const Profiler::Row& row : run.profiler().rows()) passes[row.name] = row.p50;
        json["encodings"].push_back({{"name", run.name()},
                                     {"width", run.width()},
                                     {"milliseconds", 1e3 * seconds},
                                     {"ns_per_row", 1e9 * seconds / options.rows},
                                     {"time_ratio", median(run.ratios)},
                                     {"passes", passes}});
    }
    json["rows"] = options.rows;
    json["precision"] = options.precision;
    json["device"] = device.description().name;
    return json;
}

void printTable(std::deque<EncodingRun>& runs, const BenchEncodingsOptions& options, const Device& device) {
    printResult("{}: {} rows of {} inputs, {} precision\n", device.description().name, options.rows, kInputs,
                options.precision);
    printResult("{:<30}{:>7}{:>9}{:>9}{:>7}   passes, ms\n", "position, one-blob", "values", "ms", "ns/row",
                "time");
    for (EncodingRun& run : runs) {
        const double seconds = median(run.seconds);
        printResult("{:<30}{:>7}{:>9.3f}{:>9.1f}{:>6.2f}x  ", run.name(), run.width(), 1e3 * seconds,
                    1e9 * seconds / options.rows, median(run.ratios));
        for (const Profiler::Row& row : run.profiler().rows())
            printResult(" {} {:.3f}", row.name.substr(row.name.find('_') + 1), row.p50);
        printResult("\n");
    }
}

void benchEncodings(const BenchEncodingsOptions& options) {
    checkOutputs({{"--json", options.json}}, {});
    catchInterrupts();
    Device device(options.device);
    const uint32_t capacity = (options.rows + gpu::kRowPadding - 1) / gpu::kRowPadding * gpu::kRowPadding;
    const Buffer inputs = uniformInputs(device, capacity);
    const Buffer counters = makeBuffer<uint32_t>(device, "counters", {options.rows});
    const Precision precision = options.precision == "half" ? Precision::Half : Precision::Float;
    std::deque<EncodingRun> runs; // which stay where they are
    for (Composite& composite : composites())
        runs.emplace_back(device, std::move(composite), precision, inputs, counters, capacity);

    for (EncodingRun& run : runs) run.run(); // compiles
    stopIfInterrupted();
    uint32_t rounds = 0;
    for (; rounds < options.rounds && !interruptedBy(); ++rounds)
        for (EncodingRun& run : runs) {
            run.seconds.push_back(median(repeated([&] { return run.run(); })));
            run.ratios.push_back(run.seconds.back() / runs.front().seconds.back());
        }
    if (options.json != "-") printTable(runs, options, device);
    if (!options.json.empty()) writeJson(options.json, toJson(runs, options, device));
    endIfInterrupted(rounds, "rounds");
}

} // namespace

void addBenchEncodings(CLI::App& bench) {
    auto options = std::make_shared<BenchEncodingsOptions>();
    CLI::App* command =
        bench.add_subcommand("encodings", "The radiance cache's inputs with one encoding or another");
    addWhole(*command, "--rows", options->rows, "Rows encoded", 1, 1u << 20)->capture_default_str();
    addWhole(*command, "--rounds", options->rounds, "Rounds, each timing all; medians count", 1, 10000)
        ->capture_default_str();
    command->add_option("--precision", options->precision, "Of the encoded values")
        ->check(CLI::IsMember({"float", "half"}))
        ->capture_default_str();
    addOutput(*command, "--json", options->json, "File for the numbers, - for stdout");
    command->add_option("--device", options->device.select, "Index, name, cpu or gpu")->group("Device");
    command->callback([options] { benchEncodings(*options); });
}

} // namespace irradia
