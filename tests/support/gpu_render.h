// Renders a scene with the wavefront path tracer, as tests want it: one call, the estimate in double
// precision.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "tests/reference/image_estimate.h"

namespace irradia::test {

// Of size x size pixels.
PathTracerOptions picture(uint32_t size, uint32_t maxBounces);

// A scene on a device; renders any number of pictures of it.
class GpuRenderer {
public:
    GpuRenderer(Device& device, const Scene& scene);

    // `frames` frames of options.samplesPerFrame samples, frame numbers from `firstFrame`.
    FilmImage render(const Camera& camera, const PathTracerOptions& options, uint32_t frames,
                     uint32_t firstFrame = 0);

private:
    Device& device_;
    GpuScene scene_;
};

// Mean and variance of the mean; needs at least two frames.
reference::ImageEstimate toEstimate(const FilmImage& film);

} // namespace irradia::test
