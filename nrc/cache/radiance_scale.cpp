#include "nrc/cache/radiance_scale.h"

#include "kernels/cache.h"

namespace irradia {

RadianceScale::RadianceScale(Device& device)
    : device_(device)
    , state_(makeBuffer(device, "cache state", std::vector{gpu::CacheState{1.0f, 1.0f, 0, 0, 0, 0, 0, 0}}))
    , rescaleOutputs_(device, kernels::rescale_outputs) {}

void RadianceScale::follow(FrameGraph& graph, const Trainer& trainer) const {
    const OutputActivation output = trainer.config().network.outputActivation;
    if (output != OutputActivation::None && output != OutputActivation::ReLU) return;
    const OutputLayer layer = trainer.outputLayer();
    const gpu::RescaleParams params{static_cast<uint32_t>(layer.values.bytes / 16)};
    graph.pass(rescaleOutputs_)
        .read(state_)
        .readWrite(layer.values)
        .readWrite(layer.averages)
        .push(params)
        .dispatch(params.quads);
}

gpu::CacheState RadianceScale::read() const {
    return download<gpu::CacheState>(device_, state_, 1).front();
}

void RadianceScale::set(const gpu::CacheState& state) {
    upload<gpu::CacheState>(device_, state_, std::vector{state});
}

} // namespace irradia
