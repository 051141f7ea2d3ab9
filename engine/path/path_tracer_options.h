// What a wavefront path tracer is made for.
#pragma once

#include "engine/path/vertex_kernels.h"
#include "shared/path.h"
#include <cstdint>

namespace irradia {

struct PathTracerOptions {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t maxBounces = 16;     // a path has at most maxBounces + 2 edges, light connection included
    uint32_t samplesPerFrame = 1; // samples of a pixel that make one frame
    uint32_t seed = 1;
    uint32_t sampler = gpu::kSamplerSobol; // where the paths' numbers come from
    bool layers = false;                   // gather the AOV layers
    uint32_t waveSize = 0; // paths in flight; 0 = the device class's default. Changes no result.
    VertexKernels kernels = plainVertexKernels(); // with a tap other than none, traceWave is given one
    uint32_t unseenPaths = 0; // that only a tap wants: of one kind in a frame at most, beside those of pixels
    uint32_t view = gpu::kViewPicture; // what the film shows; all else needs a tap that counts it

    uint32_t pixels() const { return width * height; }
};

} // namespace irradia
