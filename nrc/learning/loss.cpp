#include "nrc/learning/loss.h"

#include "engine/error.h"
#include "kernels/learning.h"
#include "shared/constants.h"

namespace irradia {

Loss::Loss(Device& device, const LossConfig& config, uint32_t outputs, float lossScale, float gradientLimit)
    : config_(config)
    , outputs_(outputs)
    , lossScale_(lossScale)
    , gradientLimit_(gradientLimit) {
    if (config.type == LossType::RelativeL2Luminance && outputs != 3)
        fail(ExitCode::BadData, "loss: RelativeL2Luminance needs the 3 outputs of a colour, not {}", outputs);
    KernelOptions options;
    options.constants = {{gpu::kConstantLoss, static_cast<uint32_t>(config.type)},
                         {gpu::kConstantLossOutputs, outputs}};
    loss_ = Kernel(device, kernels::loss, options);
    endBatch_ = Kernel(device, kernels::end_batch);
}

void Loss::evaluate(FrameGraph& graph, uint32_t rows, BufferRange state, BufferRange results,
                    BufferRange targets, BufferRange usable, BufferRange resultGradient, BufferRange rowSums,
                    uint32_t first) const {
    const gpu::LossParams params{static_cast<float>(config_.epsilon),
                                 static_cast<float>(config_.exponentStart),
                                 static_cast<float>(config_.exponentEnd),
                                 config_.annealStart,
                                 config_.annealEnd,
                                 lossScale_,
                                 gradientLimit_,
                                 first};
    graph.pass(loss_)
        .readWrite(state)
        .read(results)
        .read(targets)
        .read(usable)
        .write(resultGradient)
        .write(rowSums)
        .push(params)
        .dispatch(rows);
}

void Loss::endBatch(FrameGraph& graph, BufferRange state, BufferRange rowSums, uint32_t batch) const {
    graph.pass(endBatch_)
        .readWrite(state)
        .read(rowSums)
        .push(gpu::EndBatchParams{outputs_, lossScale_, batch})
        .dispatchGroups(1);
}

} // namespace irradia
