#include "engine/path/wavefront_path_tracer.h"

#include "engine/path/frame_constants.h"
#include "shared/queue.h"
#include <algorithm>
#include <iterator>

namespace irradia {

WavefrontPathTracer::WavefrontPathTracer(Device& device, const GpuScene& scene,
                                         const PathTracerOptions& options, Profiler* profiler)
    : device_(device)
    , scene_(scene)
    , options_(options)
    , graph_(device, profiler)
    , waveSize_(WaveBuffers::largestWave(device.isCpu(), options))
    , buffers_(device, options, scene.needs.transparency)
    , constants_(device, "frame constants", sizeof(FrameUniforms))
    , cameraRays_(device, scene, options)
    , surfaceRays_(device, scene, options)
    , bounces_(device, scene, options, buffers_, constants_)
    , film_(device, scene, options) {}

std::vector<Device::PlannedBuffer> WavefrontPathTracer::planned(bool isCpu,
                                                                const PathTracerOptions& options) {
    auto list = WaveBuffers::planned(isCpu, options);
    auto film = Film::planned(isCpu, options);
    list.insert(list.end(), std::move_iterator(film.begin()), std::move_iterator(film.end()));
    list.push_back({"frame constants", sizeof(FrameUniforms)});
    return list;
}

void WavefrontPathTracer::renderFrame(const Camera& camera, uint32_t index) {
    beginFrame(camera, index);
    for (Waves waves = this->waves(); const auto wave = waves.next();) {
        traceWave(*wave);
        addToFilm(*wave);
    }
    graph_.execute();
    endFrame();
}

void WavefrontPathTracer::beginFrame(const Camera& camera, uint32_t index) {
    frame_ = index;
    graph_.update(constants_, frameUniforms(scene_, options_, camera));
    graph_.fill(buffers_.counters, 0);
}

Waves WavefrontPathTracer::waves() const {
    return {0, options_.pixels(), options_.samplesPerFrame, waveSize_};
}

Waves WavefrontPathTracer::unseenCameraWaves(uint32_t paths, uint32_t most) const {
    return {gpu::kFirstTrainingPixel, paths, 1, std::min(waveSize_, most)};
}

Waves WavefrontPathTracer::surfaceWaves(uint32_t paths, uint32_t most) const {
    return {gpu::kFirstSurfacePath, paths, 1, std::min(waveSize_, most)};
}

gpu::WaveParams WavefrontPathTracer::paramsOf(const Wave& wave) const {
    return {wave.firstPixel,
            frame_ * options_.samplesPerFrame + wave.firstSample,
            wave.log2Samples,
            wave.paths(),
            0,
            0};
}

void WavefrontPathTracer::traceWave(const Wave& wave, const PathTap* tap) {
    const gpu::WaveParams params = paramsOf(wave);
    cameraRays_.generate(graph_, buffers_, constants_, params);
    follow(wave, params, tap);
}

void WavefrontPathTracer::traceSurfaceWave(const Wave& wave, float distance, const PathTap& tap) {
    const gpu::WaveParams params = paramsOf(wave);
    surfaceRays_.generate(graph_, buffers_, constants_, params, distance);
    follow(wave, params, &tap);
}

// The last ray of the picture's paths only meets emission. For who listens they may go on, and end at a
// vertex.
void WavefrontPathTracer::follow(const Wave& wave, gpu::WaveParams params, const PathTap* tap) {
    const bool goesOn = tap && tap->lastDepth;
    const uint32_t seen = wave.isSeen() ? deepestRay() : 0;
    const uint32_t last = goesOn ? std::max(seen, *tap->lastDepth) : seen;
    for (params.depth = 0; params.depth <= last; ++params.depth) {
        params.queueParity = params.depth & 1u;
        const bool areTraced = params.depth > 0 || !wave.startsAtSurfaces();
        bounces_.add(graph_, params, areTraced, goesOn || params.depth < last, tap);
        if (params.depth == 0 && wave.isSeen())
            film_.recordLayers(graph_, buffers_, constants_, wave, params);
    }
}

uint64_t WavefrontPathTracer::raysTraced() const {
    // The last bounce's shadow rays are counted by the begin_bounce after them: add what is left over.
    const auto counters = download<uint32_t>(device_, buffers_.counters, gpu::kCounters);
    return uint64_t(counters[gpu::kTracedRays]) + (uint64_t(counters[gpu::kTracedRaysHigh]) << 32) +
           counters[gpu::kShadowRayCounter];
}

} // namespace irradia
