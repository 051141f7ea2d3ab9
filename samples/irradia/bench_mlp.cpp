// irradia bench mlp: the fused networks against the machine's peak, textbook kernels and oneDNN, in
// interleaved rounds.
#include "bench_mlp_report.h"
#include "bench_tools.h"
#include "commands.h"
#include "engine/error.h"
#include "request_options.h"
#include "samples/session/kernel_form.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/outputs.h"
#include "samples/yardsticks/cpu_peak.h"
#include <charconv>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

struct BenchMlpOptions {
    std::vector<std::string> shapes;
    uint32_t inputs = 0;
    std::string precision = "both";
    std::string mode = "both";
    uint32_t rowsPerLane = 0;
    uint32_t rows = 1u << 16;
    uint32_t trainRows = 1u << 14;
    uint32_t rounds = 9;
    bool isQuick = false;
    bool withPasses = false;
    bool compileTimes = false;
    std::string json;
    DeviceOptions device;
    std::string form = "auto";
};

constexpr uint32_t kQuickRounds = 3;
constexpr uint32_t kOutputs = 3;

uint32_t parseCount(const std::string& shape, std::string_view text, uint32_t most) {
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value == 0 || value > most)
        fail(ExitCode::Usage, "--shape {}: is not WxL, a width and a number of hidden layers", shape);
    return value;
}

MlpShape parseShape(const std::string& text, uint32_t inputs) {
    const size_t x = text.find('x');
    if (x == std::string::npos)
        fail(ExitCode::Usage, "--shape {}: is not WxL, a width and a number of hidden layers", text);
    MlpShape shape;
    shape.width = parseCount(text, std::string_view(text).substr(0, x), 128);
    shape.hiddenLayers = parseCount(text, std::string_view(text).substr(x + 1), 8);
    shape.inputs = inputs ? inputs : shape.width == 32 ? 32 : 64;
    shape.outputs = kOutputs;
    return shape;
}

std::vector<MlpShape> shapesOf(const BenchMlpOptions& options) {
    std::vector<std::string> names = options.shapes;
    if (names.empty())
        names = options.isQuick ? std::vector<std::string>{"64x5"}
                                : std::vector<std::string>{"64x5", "64x2", "32x2", "16x2", "128x2"};
    std::vector<MlpShape> shapes;
    for (const std::string& name : names) shapes.push_back(parseShape(name, options.inputs));
    return shapes;
}

std::vector<NetworkForm> formsOf(const BenchMlpOptions& options) {
    const NetworkForm form = kernelForm(options.form).network;
    if (form != NetworkForm::Auto) return {form};
    return {NetworkForm::Subgroup, NetworkForm::Workgroup};
}

std::vector<Precision> precisionsOf(const BenchMlpOptions& options) {
    if (options.precision == "float") return {Precision::Float};
    if (options.precision == "half") return {Precision::Half};
    return {Precision::Float, Precision::Half};
}

std::vector<MlpGroup> groupsOf(const BenchMlpOptions& options) {
    std::vector<MlpGroup> groups;
    for (const bool isTraining : {false, true}) {
        if (options.mode == (isTraining ? "inference" : "training")) continue;
        for (const MlpShape& shape : shapesOf(options))
            groups.push_back({shape, isTraining, isTraining ? options.trainRows : options.rows,
                              formsOf(options), precisionsOf(options), options.rowsPerLane});
    }
    return groups;
}

void compileTimes(const BenchMlpOptions& options, const std::vector<MlpGroup>& groups) {
    std::vector<MlpCase> cases;
    for (const MlpGroup& group : groups)
        for (const NetworkForm form : group.forms)
            for (const Precision precision : group.precisions)
                cases.push_back({group.shape, form, precision, group.isTraining, group.rowsPerLane});
    const std::vector<CompileTime> times = measureCompileTimes(options.device, cases);
    if (options.json != "-") printCompileTimes(times);
    if (!options.json.empty())
        writeJson(options.json, toJson(times, Device(options.device).description().name));
}

void benchMlp(BenchMlpOptions options) {
    options.device.quads = kernelForm(options.form).access;
    if (options.isQuick) options.rounds = std::min(options.rounds, kQuickRounds);
    const std::vector<MlpGroup> groups = groupsOf(options);
    checkOutputs({{"--json", options.json}}, {});
    catchInterrupts();
    if (options.compileTimes) return compileTimes(options, groups);
    Device device(options.device);
    const uint32_t threads = cpuThreads(device);
    const MlpMachine machine{device.description().name, threads, device.subgroupSize(),
                             device.isCpu() ? measureCopyBandwidth(threads) : 0.0};
    const bool withTable = options.json != "-";
    if (withTable) printHeading(machine);
    std::vector<MlpResult> results;
    for (const MlpGroup& group : groups) {
        if (!results.empty() && interruptedBy()) break;
        const std::vector<MlpResult> some = runRounds(device, group, options.rounds, threads);
        if (withTable) printResults(some, options.withPasses);
        results.insert(results.end(), some.begin(), some.end());
    }
    if (results.empty()) fail(ExitCode::BadData, "no network of those asked for fits {}", machine.device);
    if (!options.json.empty()) writeJson(options.json, toJson(results, machine));
    endIfInterrupted(results.size(), "networks");
}

void addCaseOptions(CLI::App& command, BenchMlpOptions& options) {
    command.add_option("--shape", options.shapes, "Width x hidden layers, WxL; repeat for more")
        ->group("Networks")
        ->default_str("64x5 64x2 32x2 16x2 128x2");
    addWhole(command, "--inputs", options.inputs,
             "Encoded inputs, a multiple of 16; 64, for a width of 32 as many", 16, 256)
        ->group("Networks");
    const auto choice = [&](const char* name, std::string& value, const char* meaning,
                            const std::vector<std::string>& names) {
        command.add_option(name, value, meaning)
            ->check(CLI::IsMember(names))
            ->group("Networks")
            ->capture_default_str();
    };
    choice("--precision", options.precision, "Of weights and activations", {"both", "float", "half"});
    choice("--mode", options.mode, "What is timed", {"both", "inference", "training"});
    addWhole(command, "--rows-per-lane", options.rowsPerLane,
             "Of evaluations in the subgroup form; the network's choice if none", 1, 4)
        ->group("Networks");
}

void addRoundOptions(CLI::App& command, BenchMlpOptions& options) {
    constexpr uint32_t kMostRows = 1u << 20;
    addWhole(command, "--rows", options.rows, "Rows evaluated", 1, kMostRows)
        ->group("Rounds")
        ->capture_default_str();
    addWhole(command, "--train-rows", options.trainRows, "Rows of a training step", 1, kMostRows)
        ->group("Rounds")
        ->capture_default_str();
    addWhole(command, "--rounds", options.rounds, "Rounds, each timing all; medians count", 1, 10000)
        ->group("Rounds")
        ->capture_default_str();
    command.add_flag("--quick", options.isQuick, fmt::format("64x5 alone and {} rounds", kQuickRounds))
        ->group("Rounds");
    command
        .add_flag(
            "--compile-times", options.compileTimes,
            "Instead: seconds of each kernel's first execution, with an empty shader cache and a full one")
        ->group("Rounds");
}

} // namespace

void addBenchMlp(CLI::App& bench) {
    auto options = std::make_shared<BenchMlpOptions>();
    CLI::App* command = bench.add_subcommand(
        "mlp",
        "The networks, evaluated and trained, against the machine's peak, textbook kernels and oneDNN");
    addCaseOptions(*command, *options);
    addRoundOptions(*command, *options);
    command->add_flag("--passes", options->withPasses, "Also the time of each pass")->group("Output");
    addOutput(*command, "--json", options->json, "File for the numbers, - for stdout")->group("Output");
    command->add_option("--device", options->device.select, "Index, name, cpu or gpu")->group("Device");
    addSubgroup(*command, options->device.subgroupSize)->group("Device");
    addForm(
        *command, options->form, kernelFormNames(),
        "Of the kernels: texel or storage (how they read queues), subgroup or workgroup (how they compute "
        "networks; both are timed unless one is named), or auto");
    command->callback([options] { benchMlp(*options); });
}

} // namespace irradia
