#include "tests/support/gpu_render.h"

namespace irradia::test {

PathTracerOptions picture(uint32_t size, uint32_t maxBounces) {
    PathTracerOptions options;
    options.width = options.height = size;
    options.maxBounces = maxBounces;
    return options;
}

GpuRenderer::GpuRenderer(Device& device, const Scene& scene)
    : device_(device)
    , scene_(uploadScene(device, packScene(scene), buildBvh(scene))) {}

FilmImage GpuRenderer::render(const Camera& camera, const PathTracerOptions& options, uint32_t frames,
                              uint32_t firstFrame) {
    WavefrontPathTracer tracer(device_, scene_, options);
    for (uint32_t i = 0; i < frames; ++i) tracer.renderFrame(camera, firstFrame + i);
    return tracer.readFilm();
}

reference::ImageEstimate toEstimate(const FilmImage& film) {
    reference::ImageEstimate estimate;
    estimate.width = film.width;
    estimate.height = film.height;
    for (size_t i = 0; i < film.mean.size(); ++i) {
        estimate.mean.emplace_back(film.mean[i]);
        estimate.variance.emplace_back(film.variance.at(i));
    }
    return estimate;
}

} // namespace irradia::test
