// The kernels of a path's vertices, compiled with one tap and one light sampler: folders of shaders/path/taps
// and shaders/path/light_samplers, chosen by the kernels' variants (cmake/shaders.cmake).
#pragma once

#include "engine/gpu/kernel.h"

namespace irradia {

struct VertexKernels {
    const KernelSource* handleEscapedRays = nullptr;
    const KernelSource* handleEmissiveHits = nullptr;
    const KernelSource* scatter = nullptr;
    const KernelSource* addDirectLight = nullptr;
    const KernelSource* addFilteredLight = nullptr; // likewise, where surfaces let light through
    bool keepsPathStates = false; // the tap has a quad per path of a wave: WavefrontPathTracer::pathStates

    bool operator==(const VertexKernels&) const = default;
};

VertexKernels plainVertexKernels();  // nobody listens
VertexKernels cachedVertexKernels(); // a radiance cache does

} // namespace irradia
