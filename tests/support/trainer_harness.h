// A small Trainer fed with records as plain matrices, all that it has learned, and its twin of the reference.
#pragma once

#include "nrc/learning/trainer.h"
#include "shared/training.h"
#include "tests/reference/training.h"

namespace irradia::test {

constexpr uint32_t kTrainerInputs = 5, kTrainerOutputs = 3;
constexpr uint32_t kTrainerBatch = 256; // records of a step at most

struct TrainingRecords {
    std::vector<double> inputs;  // rows of kTrainerInputs
    std::vector<double> targets; // rows of kTrainerOutputs

    uint32_t count() const { return static_cast<uint32_t>(targets.size() / kTrainerOutputs); }
    std::vector<double> inputRow(uint32_t row) const;
};

// Inputs in +-1, targets in [0, 1).
TrainingRecords randomQuads(uint32_t count, uint64_t seed);

// A 16x2 network on the inputs as they are, with losses and an optimiser of JSON; Adam's epsilon is large
// (1e-3), so that a step follows from its gradient without dividing by nearly nothing.
ModelConfig smallModel(const std::string& loss = R"({"otype": "L2"})",
                       const std::string& optimizer = R"({"otype": "Adam", "epsilon": 1e-3})");
// The same with a grid of 25 corners under the first two inputs.
ModelConfig smallGridModel(const std::string& optimizer = R"({"otype": "Adam", "epsilon": 1e-3})");

// Of weights, then features.
struct Learned {
    std::vector<float> values, firstMoments, secondMoments, averages;
    gpu::TrainingState state{};
};
// Bit for bit; of the state all that a next step can depend on, and the counts.
bool areSame(const Learned& a, const Learned& b);
bool isFinite(const Learned& learned);

class TrainerHarness {
public:
    // `padding`: of the last quad of records' rows.
    explicit TrainerHarness(const ModelConfig& config = smallModel(), uint64_t seed = 1,
                            double padding = 0.0);

    Trainer& trainer() { return trainer_; }
    const Trainer& trainer() const { return trainer_; }

    void train(const TrainingRecords& records, uint32_t steps = 1, const TrainingEffort& effort = {});
    std::vector<double> predict(const TrainingRecords& records, Weights weights);

    Learned learned() const;
    void setLearned(const Learned& learned);

    // Of the same parameters; only before the first step.
    reference::Training twin() const;

private:
    uint64_t weightCount() const { return trainer_.network().weightCount(); }

    Trainer trainer_;
    double padding_;
};

std::vector<double> doubles(const std::vector<float>& values);

} // namespace irradia::test
