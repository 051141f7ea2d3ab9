// What a Trainer holds, shared by the files that implement it: trainer.cpp, trainer_learning.cpp,
// trainer_saving.cpp.
#pragma once

#include "nrc/learning/held.h"
#include "nrc/learning/loss.h"
#include "nrc/learning/optimizer.h"
#include "nrc/learning/trainer.h"
#include "nrc/learning/trainer_sizes.h"

namespace irradia {

// What the passes of one batch hand on; reused from batch to batch, and from part to part of it.
struct BatchBuffers {
    BatchBuffers(Device& device, const TrainerSizes& sizes)
        : inputs(device, "batch inputs", sizes.inputBytes(sizes.batch.partRows))
        , targets(device, "batch targets", sizes.resultBytes(sizes.batch.partRows))
        , usable(device, "usable records", uint64_t(sizes.batch.partRows) * 4)
        , encoded(device, "encoded inputs", sizes.encodedBytes(sizes.batch.partRows))
        , activations(device, "activations", sizes.shape.activationBytes(sizes.batch.partRows))
        , results(device, "results", sizes.resultBytes(sizes.batch.partRows))
        , resultGradient(device, "result gradient", sizes.resultBytes(sizes.batch.partRows))
        , layerGradients(device, "layer gradients", sizes.shape.layerGradientBytes(sizes.batch.partRows))
        , encodedGradient(device, "gradient by encoded inputs", sizes.encodedGradientBytes())
        , rowSums(device, "row losses", uint64_t(sizes.batch.rows) * 16)
        , partials(device, "partial weight gradients", sizes.shape.partialBytes(sizes.batch.rows)) {}

    Buffer inputs, targets, usable, encoded, activations, results, resultGradient, layerGradients,
        encodedGradient;      // of a part
    Buffer rowSums, partials; // of the batch
};

struct Trainer::State {
    State(Device& device, const ModelConfig& config, uint32_t inputs, uint32_t outputs,
          const TrainerOptions& options);

    std::vector<const ParameterGroup*> groups() const {
        if (features.count == 0) return {&weights};
        return {&weights, &features};
    }

    void initialise();
    void gather(FrameGraph& graph, const Records& records, const RowRange& part);
    void learnPart(FrameGraph& graph, const Records& records, const RowRange& part);
    void learn(FrameGraph& graph, const Records& records, uint32_t number, const TrainingEffort& effort);
    void packForInference(FrameGraph& graph, Weights which);

    Device& device;
    TrainerOptions options;
    TrainerSizes sizes;
    ModelConfig config;
    Encoding encoding;
    Network network;
    Loss loss;
    Optimizer optimizer;
    ParameterGroup weights, features;
    BatchBuffers batch;
    Buffer state; // gpu::TrainingState
    Buffer packed, inferPacked, inferEncoded;
    Kernel beginBatch, gatherRecords;
    Held<Weights> inferPackedHolds;
};

} // namespace irradia
