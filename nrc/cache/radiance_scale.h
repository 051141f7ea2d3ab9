// The scale between radiance and what a network learns: a power of two that follows the targets' brightness
// (shaders/cache/count_records.comp). When it changes, the network's last layer changes along, exactly.
#pragma once

#include "engine/graph/frame_graph.h"
#include "nrc/learning/trainer.h"
#include "shared/cache.h"

namespace irradia {

class RadianceScale {
public:
    explicit RadianceScale(Device& device);

    const Buffer& state() const { return state_; } // gpu::CacheState

    // After a change of the scale, before the next training: the trainer's predictions mean the radiance that
    // they meant. Outputs that are no linear function of the last layer are left to learn what has changed.
    void follow(FrameGraph& graph, const Trainer& trainer) const;

    gpu::CacheState read() const; // of executed graphs
    void set(const gpu::CacheState& state);

private:
    Device& device_;
    Buffer state_;
    Kernel rescaleOutputs_;
};

} // namespace irradia
