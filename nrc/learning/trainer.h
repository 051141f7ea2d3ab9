// Learning: an Encoding and a Network with their parameters, a Loss and an Optimizer (tiny-cuda-nn's four
// nouns).
//
// Bit-repeatable: the same records in the same order give the same weights on the same device and driver,
// whatever the number of threads. Records that are not finite or beyond kRecordLimit are dropped and counted;
// parameters that stop being finite are set to zero and counted; a step without records changes nothing.
#pragma once

#include "nrc/learning/encoding.h"
#include "nrc/learning/model_file.h"
#include "nrc/learning/network.h"
#include "nrc/learning/trainer_options.h"
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace irradia {

// What a saved trainer alone is; whoever saves more beside it has a kind of its own.
constexpr const char* kNetworkModel = "network";

// Which parameters a prediction uses.
enum class Weights { Ema, Raw };

// Inputs: rows of ceil(inputs / 4) single-precision quads; targets: rows of ceil(outputs / 4). What pads the
// last quad is not used.
struct Records {
    RowCount rows;
    BufferRange inputs;
    BufferRange targets;
};

// Counted since the start (or the load).
struct TrainingCounts {
    uint32_t steps = 0;             // that changed the parameters
    uint32_t droppedRecords = 0;    // not finite or too large, or with a prediction or loss that is
    uint32_t clippedSteps = 0;      // whose gradient was longer than clip_norm
    uint32_t damagedParameters = 0; // weights, moments or averages found not finite, and set to zero
    float loss = 0;                 // mean of the last step, 0 before the first
    // Of the last call of train(), in its first pass: mean luminance over the usable records of what was
    // predicted before each step, and of the targets.
    float meanPrediction = 0, meanTarget = 0;
};

// What one call of train() does with its records.
struct TrainingEffort {
    // 0 = a pass; more than its batches: further passes, each in an order of its own, the last maybe cut
    // short
    uint32_t steps = 0;
    std::optional<double> emaDecay; // instead of the optimizer's, in [0, 1)
    double learningRate = 1.0;      // times the optimizer's
};

// Weights of the network's last layer, and their averages (nrc/learning/network.h's order).
struct OutputLayer {
    BufferRange values, averages;
};

class Trainer {
public:
    Trainer(Device& device, const ModelConfig& config, uint32_t inputs, uint32_t outputs,
            const TrainerOptions& options = {});
    ~Trainer();

    // The buffers that the constructor allocates, but for some of a few quads; throws what it does.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                      const ModelConfig& config, uint32_t inputs,
                                                      uint32_t outputs, const TrainerOptions& options);

    const ModelConfig& config() const; // form resolved
    const Network& network() const;
    const Encoding& encoding() const;
    uint64_t parameterCount() const; // weights, then features

    // One pass over the records in `batches` optimisation steps, unless the effort says otherwise: record i
    // belongs to exactly one of them, chosen by a permutation that is new for each pass. rows.capacity /
    // batches must not exceed batchRows.
    void train(FrameGraph& graph, const Records& records, uint32_t batches = 1,
               const TrainingEffort& effort = {});

    // results: rows of ceil(outputs / 4) single-precision quads. inputs and results hold rows.capacity rows
    // at least.
    void infer(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange results,
               Weights weights = Weights::Ema);

    TrainingCounts counts() const; // of executed graphs

    // Shape, configuration, parameters, moments, averages and counters, beside what blocks `model` has
    // already (nrc/learning/model_file.h): versioned, checked, written whole or not at all. load() throws
    // Error(BadData) naming the file and what differs where it is of another kind or shape or lacks a block,
    // and then changes nothing.
    void save(const std::filesystem::path& file, ModelFile model = ModelFile(kNetworkModel)) const;
    void load(const std::filesystem::path& file);
    void load(const ModelFile& model); // of whatever kind

    // Parameters as they are, for tests and tools: parameterCount() floats.
    std::vector<float> parameters(Weights weights) const;
    void setParameters(std::span<const float> values); // weights; the optimiser's state stays

    // For who changes what the outputs mean, before the next train(): until then predictions may come from
    // either.
    OutputLayer outputLayer() const;

    // What must be equal for one trainer to load what another saved, in words.
    std::string shapeName() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace irradia
