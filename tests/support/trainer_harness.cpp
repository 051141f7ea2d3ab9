#include "tests/support/trainer_harness.h"

#include "nrc/learning/model_file.h"
#include "shared/network.h"
#include "tests/reference/half.h"
#include "tests/reference/random.h"
#include "tests/support/kernel_harness.h"
#include "tests/support/network_rows.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_model.h"
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace irradia::test {

namespace {

constexpr uint32_t kGridCells = 4; // an edge
constexpr RowFormat kInputRows{kTrainerInputs}, kTargetRows{kTrainerOutputs};

TrainerOptions optionsWith(uint64_t seed) {
    TrainerOptions options;
    options.batchRows = kTrainerBatch;
    options.inferRows = 2 * kTrainerBatch;
    options.seed = seed;
    return options;
}

uint32_t capacityOf(const TrainingRecords& records) {
    return std::max(1u, (records.count() + gpu::kRowPadding - 1) / gpu::kRowPadding) * gpu::kRowPadding;
}

// The twin reads settings as the kernels do: in single precision.
double single(double value) {
    return static_cast<float>(value);
}

reference::OptimizerSettings settingsOf(const OptimizerConfig& config) {
    return {single(config.learningRate), single(config.gridLearningRate),
            single(config.beta1),        single(config.beta2),
            single(config.epsilon),      single(config.l2),
            single(config.emaDecay),     config.decayStart,
            config.decayInterval,        config.decayEnd,
            single(config.decayBase),    single(config.clipNorm)};
}

reference::LossSettings settingsOf(const LossConfig& config) {
    const reference::Loss types[] = {reference::Loss::L2, reference::Loss::RelativeL2,
                                     reference::Loss::RelativeL2Luminance};
    return {types[static_cast<int>(config.type)], single(config.epsilon)};
}

reference::FeatureGrid smallGrid() {
    reference::GridLevel level = reference::gridLevel(0, kGridCells, 2.0);
    level.entry = [](const reference::Corner& corner) { return corner[0] + (kGridCells + 1) * corner[1]; };
    return {{level}, 2, false};
}

ModelConfig modelOf(const std::string& encoding, const std::string& loss, const std::string& optimizer) {
    return parseModelConfig(wholeModel(fmt::format(R"({{"encoding": {},
        "network": {{"n_neurons": 16, "n_hidden_layers": 2}}, "loss": {}, "optimizer": {}}})",
                                                   encoding, loss, optimizer)),
                            "small model");
}

template <typename T>
bool sameBytes(const T& a, const T& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

} // namespace

std::vector<double> TrainingRecords::inputRow(uint32_t row) const {
    const auto begin = inputs.begin() + ptrdiff_t{row} * kTrainerInputs;
    return {begin, begin + kTrainerInputs};
}

TrainingRecords randomQuads(uint32_t count, uint64_t seed) {
    reference::Random random(seed);
    TrainingRecords records;
    for (uint32_t i = 0; i < count * kTrainerInputs; ++i)
        records.inputs.push_back(stored(2.0 * random.uniform() - 1.0, Precision::Float));
    for (uint32_t i = 0; i < count * kTrainerOutputs; ++i)
        records.targets.push_back(stored(random.uniform(), Precision::Float));
    return records;
}

ModelConfig smallModel(const std::string& loss, const std::string& optimizer) {
    return modelOf(R"({"otype": "Identity"})", loss, optimizer);
}

ModelConfig smallGridModel(const std::string& optimizer) {
    return modelOf(fmt::format(R"({{"otype": "Composite", "nested": [
        {{"otype": "DenseGrid", "n_dims_to_encode": 2, "n_levels": 1, "n_features_per_level": 2,
          "base_resolution": {}}}, {{"otype": "Identity"}}]}})",
                               kGridCells),
                   R"({"otype": "RelativeL2"})", optimizer);
}

bool areSame(const Learned& a, const Learned& b) {
    const auto lasting = [](const gpu::TrainingState& s) {
        return std::vector<uint32_t>{s.steps,
                                     s.droppedRecords,
                                     s.clippedSteps,
                                     s.damagedParameters,
                                     std::bit_cast<uint32_t>(s.learningRateFactor),
                                     std::bit_cast<uint32_t>(s.eta1),
                                     std::bit_cast<uint32_t>(s.eta2),
                                     std::bit_cast<uint32_t>(s.etaEma),
                                     std::bit_cast<uint32_t>(s.loss)};
    };
    return sameBytes(a.values, b.values) && sameBytes(a.firstMoments, b.firstMoments) &&
           sameBytes(a.secondMoments, b.secondMoments) && sameBytes(a.averages, b.averages) &&
           lasting(a.state) == lasting(b.state);
}

bool isFinite(const Learned& learned) {
    for (const auto* values :
         {&learned.values, &learned.firstMoments, &learned.secondMoments, &learned.averages})
        for (const float v : *values)
            if (!std::isfinite(v)) return false;
    return true;
}

std::vector<double> doubles(const std::vector<float>& values) {
    return {values.begin(), values.end()};
}

TrainerHarness::TrainerHarness(const ModelConfig& config, uint64_t seed, double padding)
    : trainer_(validatedDevice(), config, kTrainerInputs, kTrainerOutputs, optionsWith(seed))
    , padding_(padding) {}

void TrainerHarness::train(const TrainingRecords& records, uint32_t steps, const TrainingEffort& effort) {
    const uint32_t capacity = capacityOf(records);
    const Buffer counters = makeBuffer<uint32_t>(validatedDevice(), "counters", {capacity, records.count()});
    const Buffer inputs = rowBuffer(kInputRows, capacity, records.inputs, padding_);
    const Buffer targets = rowBuffer(kTargetRows, capacity, records.targets, padding_);
    FrameGraph graph(validatedDevice());
    trainer_.train(graph, {{counters, 1, capacity}, inputs, targets}, steps, effort);
    graph.execute();
}

std::vector<double> TrainerHarness::predict(const TrainingRecords& records, Weights weights) {
    const uint32_t capacity = capacityOf(records);
    const Buffer counters = makeBuffer<uint32_t>(validatedDevice(), "counters", {capacity, records.count()});
    const Buffer inputs = rowBuffer(kInputRows, capacity, records.inputs, padding_);
    const Buffer results(validatedDevice(), "results", kTargetRows.bytes(capacity));
    FrameGraph graph(validatedDevice());
    trainer_.infer(graph, {counters, 1, capacity}, inputs, results, weights);
    graph.execute();
    return downloadRows(results, kTargetRows, records.count());
}

// A saved model is the only place where moments are seen.
Learned TrainerHarness::learned() const {
    const TemporaryFolder folder;
    trainer_.save(folder / "model");
    const ModelFile file = ModelFile::read(folder / "model", kNetworkModel);
    const auto floats = [&](const char* name) { return file.values<float>(name, trainer_.parameterCount()); };
    return {floats("parameters"), floats("first moments"), floats("second moments"), floats("averages"),
            file.values<gpu::TrainingState>("counters", 1).front()};
}

void TrainerHarness::setLearned(const Learned& learned) {
    ModelFile file(kNetworkModel);
    file.addText("shape", trainer_.shapeName());
    file.add<gpu::TrainingState>("counters", std::span(&learned.state, 1));
    file.add<float>("parameters", learned.values);
    file.add<float>("first moments", learned.firstMoments);
    file.add<float>("second moments", learned.secondMoments);
    file.add<float>("averages", learned.averages);
    trainer_.load(file);
}

reference::Training TrainerHarness::twin() const {
    const ModelConfig& config = trainer_.config();
    reference::Mlp network{trainer_.encoding().width(), config.network.width, config.network.hiddenLayers,
                           kTrainerOutputs};
    if (config.network.precision == Precision::Half) {
        network.store = reference::roundToHalf;
        network.handsOnStored = config.network.form == NetworkForm::Workgroup;
    }
    reference::Training twin{
        network,
        settingsOf(config.loss),
        single(config.loss.exponentStart),
        single(config.loss.exponentEnd),
        double(config.loss.annealStart),
        double(config.loss.annealEnd),
        {settingsOf(config.optimizer), weightCount(), doubles(trainer_.parameters(Weights::Raw))}};
    if (trainer_.encoding().featureCount() > 0) {
        twin.grid = smallGrid();
        twin.gridInputs = 2;
    }
    if (network.store) twin.gradientScale = single(config.optimizer.lossScale);
    return twin;
}

} // namespace irradia::test
