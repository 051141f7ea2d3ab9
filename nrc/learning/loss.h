// Losses of a batch: L2; relative L2 (Lehtinen 2018); relative by the luminance of the prediction (Müller
// 2021, 4.3). Denominators are detached: no gradient passes through them.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/config.h"
#include "shared/training.h"

namespace irradia {

class Loss {
public:
    // Throws Error(BadData) where a loss by luminance is asked of other than 3 outputs.
    // gradientLimit: at which the scaled gradients of single results are cut.
    Loss(Device& device, const LossConfig& config, uint32_t outputs, float lossScale,
         float gradientLimit = gpu::kGradientLimit);

    // Of rows [first, first + rows) of the batch; how many it has is in `state` (gpu::TrainingState), whose
    // counts it advances. `usable`: a word a row, 0 where the record is to be left out. resultGradient: rows
    // as `results`, times lossScale and cut, before the mean; rowSums: a quad a row, of its loss, the
    // luminance of prediction and target, and 1; zeros where it was not used.
    void evaluate(FrameGraph& graph, uint32_t rows, BufferRange state, BufferRange results,
                  BufferRange targets, BufferRange usable, BufferRange resultGradient, BufferRange rowSums,
                  uint32_t first = 0) const;
    // The batch's mean loss and the factor of its gradients, into `state`, and the means of the luminance
    // over the first pass, of which it is number `batch` (gpu::kLaterPass: it is not).
    void endBatch(FrameGraph& graph, BufferRange state, BufferRange rowSums, uint32_t batch = 0) const;

private:
    LossConfig config_;
    uint32_t outputs_;
    float lossScale_, gradientLimit_;
    Kernel loss_, endBatch_;
};

} // namespace irradia
