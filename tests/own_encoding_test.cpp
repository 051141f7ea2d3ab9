// An encoding more: its kernel (tests/shaders/encode_square.comp), what it is, and a line in the table.
// Nothing else has to know of it.
#include "kernels/shaders.h"
#include "nrc/learning/encodings/table.h"
#include "tests/support/expect_error.h"
#include "tests/support/network_rows.h"
#include "tests/support/trainer_harness.h"
#include "tests/support/validated_device.h"
#include "tests/support/whole_model.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

using namespace irradia;
using namespace irradia::test;

namespace {

namespace fs = std::filesystem;

EncodingKind square() {
    return {.otype = "Square",
            .keys = {optionalNumberKey("scale", {0, 100}, 1.0)},
            .values = [](const EncodingConfig& config) { return config.dims; },
            .treatsInputsAlike = true,
            .kernel = &kernels::encode_square,
            .halfKernel = &kernels::encode_square_half,
            .constants = [](const EncodingConfig& config) -> std::vector<uint32_t> {
                return {floatBits(config.number("scale"))};
            }};
}

// Once in a process: each test case may be run alone.
void addSquare() {
    static const EncodingKind& added = encodingKinds().emplace_back(square());
    static_cast<void>(added);
}

ModelConfig parse(const std::string& encoding) {
    addSquare();
    return parseModelConfig(wholeModel("{\"encoding\": " + encoding + R"(,
        "network": {"n_neurons": 16, "n_hidden_layers": 2},
        "optimizer": {"otype": "Adam", "learning_rate": 0.01}})"),
                            "model.json");
}

// Neighbours that share a kernel, one that does not, and one of another kind.
constexpr const char* kComposite = R"({"otype": "Composite", "nested": [
    {"otype": "Square", "n_dims_to_encode": 4, "scale": 3}, {"otype": "Square", "n_dims_to_encode": 3, "scale": 3},
    {"otype": "Square", "n_dims_to_encode": 1}, {"otype": "Identity"}]})";

double expectedValue(const std::vector<double>& x, size_t value) {
    if (value < 7) return 3.0 * x[value] * x[value];
    if (value == 8) return x[7] * x[7];
    if (value == 12 || value == 13) return x[value - 4];
    return 1.0;
}

} // namespace

TEST_CASE("its keys are read, written and checked as those of the others") {
    const ModelConfig config = parse(kComposite);
    REQUIRE(config.encoding.size() == 4);
    CHECK(config.encoding[0] == makeEncoding("Square", 4, {{"scale", 3}}));
    CHECK(config.encoding[2] == makeEncoding("Square", 1));
    CHECK(parseModelConfig(toJson(config), "recorded") == config);
    expectError(ExitCode::BadData,
                "model.json: unknown key encoding.bins, there are otype, n_dims_to_encode, scale",
                [] { parse(R"({"otype": "Square", "bins": 3})"); });
    expectError(ExitCode::BadData, "encoding.scale must be a number from 0 to 100, not 101",
                [] { parse(R"({"otype": "Square", "scale": 101})"); });
    expectError(ExitCode::BadData, "HashGrid, Square, not \"Cube\"", [] { parse(R"({"otype": "Cube"})"); });
    expectError(ExitCode::Internal, "a Square has no bins", [] { makeEncoding("Square", 1, {{"bins", 3}}); });
}

TEST_CASE("it encodes, in both precisions") {
    const ModelConfig config = parse(kComposite);
    constexpr uint32_t kRows = 256, kInputs = 10;
    std::vector<double> inputs;
    for (uint32_t i = 0; i < kRows * kInputs; ++i) inputs.push_back(0.001 * (i % 1999) - 1.0);
    const RowFormat inputRows{kInputs, Precision::Float};
    for (double& x : inputs) x = stored(x, Precision::Float);
    const Buffer counters = makeBuffer<uint32_t>(validatedDevice(), "counters", {kRows});
    const Buffer rows = rowBuffer(inputRows, kRows, inputs, 0.0);
    const Buffer none(validatedDevice(), "features", 16);
    for (const Precision precision : {Precision::Float, Precision::Half}) {
        const Encoding encoding(validatedDevice(), config.encoding, kInputs, precision);
        CHECK(encoding.width() == 16);
        const RowFormat encodedRows{encoding.width(), precision};
        const Buffer encoded = rowBuffer(encodedRows, kRows, {}, 0.0);
        FrameGraph graph(validatedDevice());
        encoding.encode(graph, {counters, 0, kRows}, rows, none, encoded);
        graph.execute();
        const std::vector<double> values = downloadRows(encoded, encodedRows, kRows);
        double worst = 0.0;
        for (uint32_t row = 0; row < kRows; ++row)
            for (uint32_t v = 0; v < 16; ++v) {
                const std::vector<double> x(inputs.begin() + row * kInputs,
                                            inputs.begin() + (row + 1) * kInputs);
                worst = std::max(worst, std::abs(values[row * 16 + v] - expectedValue(x, v)));
            }
        // Two roundings of numbers below 4; in half precision the last one, of 2^-10.
        CHECK(worst <= (precision == Precision::Half ? 0x1p-10 : 0x1p-22));
    }
}

TEST_CASE("a model that has it learns") {
    TrainerHarness harness(parse(R"({"otype": "Square", "scale": 2})"));
    TrainingRecords records = randomQuads(kTrainerBatch, 1);
    for (uint32_t row = 0; row < records.count(); ++row)
        for (uint32_t o = 0; o < kTrainerOutputs; ++o) {
            const double x = records.inputs[row * kTrainerInputs + o];
            records.targets[row * kTrainerOutputs + o] = x * x;
        }
    const auto error = [&] {
        const std::vector<double> predicted = harness.predict(records, Weights::Raw);
        double sum = 0.0;
        for (size_t i = 0; i < predicted.size(); ++i) sum += std::pow(predicted[i] - records.targets[i], 2);
        return sum / static_cast<double>(predicted.size());
    };
    const double before = error();
    for (int step = 0; step < 200; ++step) harness.train(records);
    INFO(fmt::format("mean squared error {:.4f}, then {:.2g}", before, error()));
    CHECK(error() < 0.01 * before);
}

TEST_CASE("an encoding's names stand in its file and the table's alone") {
    const fs::path root = IRRADIA_SOURCE_DIR;
    size_t files = 0;
    for (const char* top : {"engine", "nrc"})
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            const fs::path extension = entry.path().extension();
            if ((extension != ".h" && extension != ".cpp") ||
                entry.path().parent_path() == root / "nrc/learning/encodings")
                continue;
            ++files;
            std::ifstream text(entry.path());
            for (std::string line; std::getline(text, line);) {
                line = line.substr(0, line.find("//"));
                bool isNamed = line.find("kernels::encode_") != std::string::npos;
                for (const EncodingKind& kind : encodingKinds())
                    isNamed = isNamed || line.find('"' + kind.otype + '"') != std::string::npos;
                if (isNamed) FAIL_CHECK(entry.path().string() << ": " << line);
            }
        }
    CHECK(files > 50);
}

TEST_CASE("the device has nothing to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
