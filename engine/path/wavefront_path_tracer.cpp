#include "engine/path/wavefront_path_tracer.h"

#include "engine/error.h"
#include "kernels/path.h"
#include "shared/network.h"
#include "shared/queue.h"
#include "shared/trace.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace irradia {

namespace {

// Constants of every kernel that includes path/needs.glsl.
KernelOptions fitted(const SceneNeeds& needs, uint32_t view, uint32_t sampler) {
    KernelOptions options;
    options.constants = {{gpu::kConstantEnvironment, needs.environment},
                         {gpu::kConstantEmitters, needs.emitters},
                         {gpu::kConstantTextures, needs.textures},
                         {gpu::kConstantSpecular, needs.specular},
                         {gpu::kConstantView, view},
                         {gpu::kConstantLightTree, needs.lightTree},
                         {gpu::kConstantSampler, sampler}};
    return options;
}

// What path/scene.glsl reads of the scene, in its order.
Pass& readSurfaces(Pass& pass, const GpuScene& scene) {
    return pass.read(scene.geometry)
        .read(scene.attributes)
        .read(scene.materials)
        .read(scene.textures)
        .read(scene.texels);
}

// What path/training_light.glsl binds.
Pass& gatherForTraining(Pass& pass, const Buffer& pathStates, const CachePaths& cache) {
    return pass.readWrite(pathStates).readWrite(cache.trainingPaths).readWrite(cache.trainingVertices);
}

bool trains(const CachePaths* cache) {
    return cache && cache->rule.tilesX > 0;
}

// Calls visit(const glm::vec4*) with the vectors of each pixel in turn; reads some of them at a time.
template <uint32_t vectors, typename Visit>
void forEachPixel(Device& device, const std::vector<Buffer>& parts, const Visit& visit) {
    constexpr uint64_t kBytes = vectors * sizeof(glm::vec4), kTogether = kBytes << 18;
    for (const Buffer& part : parts)
        for (uint64_t offset = 0; offset < part.bytes(); offset += kTogether) {
            const uint64_t bytes = std::min(kTogether, part.bytes() - offset);
            const auto values = download<glm::vec4>(device, part, bytes / sizeof(glm::vec4), offset);
            for (size_t i = 0; i < values.size(); i += vectors) visit(&values[i]);
        }
}

// scatter's, where there is a cache.
struct CachedBounceParams {
    gpu::BounceParams bounce;
    gpu::CacheRule rule;
};

} // namespace

WavefrontPathTracer::WavefrontPathTracer(Device& device, const GpuScene& scene,
                                         const PathTracerOptions& options, Profiler* profiler)
    : device_(device)
    , scene_(scene)
    , options_(options)
    , graph_(device, profiler)
    , waveSize_(PathBuffers::largestWave(device.isCpu(), options))
    , buffers_(device, options) {
    const KernelOptions fit = fitted(scene.needs, options.view, options.sampler);
    kernels_.generateCameraRays = Kernel(device, kernels::generate_camera_rays, fit);
    kernels_.beginBounce = Kernel(device, kernels::begin_bounce);
    kernels_.intersectClosest = Kernel(device, kernels::intersect_closest);
    const auto either = [&](const KernelSource& plain, const KernelSource& cached) -> const KernelSource& {
        return options.cached ? cached : plain;
    };
    kernels_.handleEscapedRays =
        Kernel(device, either(kernels::handle_escaped_rays, kernels::handle_escaped_rays_cached), fit);
    kernels_.handleEmissiveHits =
        Kernel(device, either(kernels::handle_emissive_hits, kernels::handle_emissive_hits_cached), fit);
    kernels_.recordSurfaces = Kernel(device, kernels::record_surfaces, fit);
    kernels_.scatter = Kernel(device, either(kernels::scatter, kernels::scatter_cached), fit);
    kernels_.intersectShadow = Kernel(device, kernels::intersect_shadow);
    kernels_.addDirectLight =
        Kernel(device, either(kernels::add_direct_light, kernels::add_direct_light_cached));
    kernels_.updateFilm = Kernel(device, kernels::update_film, fit);
    if (scene.areaTable) kernels_.generateSurfaceRays = Kernel(device, kernels::generate_surface_rays, fit);
}

void WavefrontPathTracer::renderFrame(const Camera& camera, uint32_t index) {
    beginFrame();
    for (Waves waves = this->waves(); const auto wave = waves.next();) {
        traceWave(camera, *wave, index);
        addToFilm(*wave);
    }
    graph_.execute();
    endFrame();
}

void WavefrontPathTracer::beginFrame() {
    graph_.fill(buffers_.counters, 0);
}

Waves WavefrontPathTracer::waves() const {
    return {0, options_.pixels(), options_.samplesPerFrame, waveSize_};
}

uint32_t WavefrontPathTracer::trainingWave() const {
    // The range that is bound begins at a whole tile of rows.
    return std::min(waveSize_, device_.limits().maxStorageBufferRange / gpu::kVertexBytes - gpu::kTileRows);
}

Waves WavefrontPathTracer::trainingWaves(uint32_t paths) const {
    return {gpu::kFirstTrainingPixel, paths, 1, trainingWave()};
}

Waves WavefrontPathTracer::surfaceWaves(uint32_t paths) const {
    return {gpu::kFirstSurfacePath, paths, 1, trainingWave()};
}

void WavefrontPathTracer::addToFilm(const Wave& wave) {
    // Of a frame's samples of a pixel the first alone may train.
    const uint32_t samples = options_.view == gpu::kViewTrainingDensity ? 1 : options_.samplesPerFrame;
    const uint32_t part =
        (wave.firstSample == 0 ? gpu::kFirstSamples : 0u) | (wave.isLast ? gpu::kLastSamples : 0u);
    const gpu::FilmParams film{wave.pixels, wave.log2Samples, part, frames_,
                               1.0f / static_cast<float>(samples)};
    graph_.pass(kernels_.updateFilm)
        .read(buffers_.radiance)
        .readWrite(buffers_.sampleSums)
        .readWrite(buffers_.ofPixels(buffers_.film, gpu::kFilmVectors, wave.firstPixel, wave.pixels))
        .push(film)
        .dispatch(wave.pixels);
    graph_.cut();
}

void WavefrontPathTracer::endFrame() {
    ++frames_;
}

void WavefrontPathTracer::forgetFilm() {
    for (const Buffer& part : buffers_.surfaces) graph_.fill(part, 0);
    frames_ = 0;
}

void WavefrontPathTracer::traceWave(const Camera& camera, const Wave& wave, uint32_t frame,
                                    const CachePaths* cache) {
    const float scale = camera.isOrthographic() ? camera.halfHeight : std::tan(0.5f * camera.verticalFov);
    const float aspect = static_cast<float>(options_.width) / static_cast<float>(options_.height);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    const gpu::CameraParams params{glm::vec4(camera.position, 0),
                                   glm::vec4(camera.forward, 0),
                                   glm::vec4(right * scale * aspect, 0),
                                   glm::vec4(camera.up * scale, 0),
                                   options_.width,
                                   options_.height,
                                   wave.firstPixel,
                                   wave.paths(),
                                   sampleIndex(wave, frame),
                                   options_.seed,
                                   wave.log2Samples,
                                   camera.isOrthographic() ? 1u : 0u};
    graph_.pass(kernels_.generateCameraRays)
        .write(buffers_.rays[0])
        .write(buffers_.radiance)
        .readWrite(buffers_.counters)
        .push(params)
        .dispatch(wave.paths());
    uint32_t last = trains(cache) ? std::max(deepestRay(), cache->rule.lastDepth) : deepestRay();
    if (!wave.isSeen()) last = cache->rule.lastDepth;
    for (uint32_t depth = 0; depth <= last; ++depth) {
        bounce(depth, wave, sampleIndex(wave, frame), cache);
        if (depth == 0 && options_.surfaces && wave.isSeen()) recordSurfaces(camera, wave);
    }
}

void WavefrontPathTracer::traceSurfaceWave(const Wave& wave, uint32_t frame, float distance,
                                           const CachePaths& cache) {
    if (!scene_.areaTable) fail(ExitCode::Internal, "the scene was packed without its area table");
    const gpu::SurfacePathParams params{wave.firstPixel,
                                        wave.paths(),
                                        sampleIndex(wave, frame),
                                        options_.seed,
                                        scene_.triangles,
                                        distance,
                                        0,
                                        0};
    Pass pass = graph_.pass(kernels_.generateSurfaceRays);
    pass.write(buffers_.rays[0]).write(buffers_.hits).readWrite(buffers_.counters);
    readSurfaces(pass, scene_).read(scene_.areaTable).push(params).dispatch(wave.paths());
    for (uint32_t depth = 0; depth <= cache.rule.lastDepth; ++depth)
        bounce(depth, wave, sampleIndex(wave, frame), &cache);
}

void WavefrontPathTracer::bounce(uint32_t depth, const Wave& wave, uint32_t sampleIndex,
                                 const CachePaths* cache) {
    const uint32_t parity = depth & 1u;
    const gpu::BounceParams params{depth,
                                   wave.firstPixel,
                                   sampleIndex,
                                   options_.seed,
                                   scene_.lightCount,
                                   scene_.environmentWidth,
                                   scene_.environmentHeight,
                                   scene_.environmentProbability,
                                   parity,
                                   wave.log2Samples,
                                   0,
                                   0};
    const bool areTraced = depth > 0 || !wave.startsAtSurfaces();
    beginBounce(parity, areTraced);
    if (areTraced) meetSurfaces(params, cache);
    graph_.cut();
    // The last ray only adds emission. Training paths go on, and the last of their rays end in the cache.
    const bool isLast = depth == deepestRay() && !trains(cache);
    if (isLast || scene_.triangles == 0) return;
    scatter(params, cache);
    graph_.pass(kernels_.intersectShadow)
        .read(scene_.bvh)
        .read(buffers_.shadowRays)
        .read(buffers_.counters)
        .write(buffers_.visibility)
        .push(gpu::TraceParams{gpu::kShadowRayCounter, scene_.bvhRoot})
        .dispatchIndirect(BufferRange(buffers_.arguments, gpu::kTraceArguments * 4, 12)); // at most one a ray
    addDirectLight(cache);
    graph_.cut();
}

void WavefrontPathTracer::beginBounce(uint32_t parity, bool areTraced) {
    const gpu::BeginBounceParams begin{parity, kernels_.intersectClosest.workgroupSize() * gpu::kRaysPerLane,
                                       kernels_.scatter.workgroupSize(), areTraced ? 1u : 0u};
    graph_.pass(kernels_.beginBounce)
        .readWrite(buffers_.counters)
        .readWrite(buffers_.arguments)
        .push(begin)
        .dispatchGroups(1);
}

// The rays' nearest hits, and the light that they meet there or beyond the scene.
void WavefrontPathTracer::meetSurfaces(const gpu::BounceParams& params, const CachePaths* cache) {
    const uint32_t parity = params.queueParity;
    const Buffer& rays = buffers_.rays[parity];
    const BufferRange itemArguments(buffers_.arguments, gpu::kItemArguments * 4, 12);
    graph_.pass(kernels_.intersectClosest)
        .read(scene_.bvh)
        .read(rays)
        .read(buffers_.counters)
        .write(buffers_.hits)
        .push(gpu::TraceParams{gpu::kRayCounter + parity, scene_.bvhRoot})
        .dispatchIndirect(BufferRange(buffers_.arguments, gpu::kTraceArguments * 4, 12));
    if (scene_.needs.environment) {
        Pass pass = graph_.pass(kernels_.handleEscapedRays);
        pass.read(rays)
            .read(buffers_.hits)
            .read(buffers_.counters)
            .readWrite(buffers_.radiance)
            .read(scene_.environment);
        if (cache) gatherForTraining(pass, buffers_.pathStates, *cache);
        pass.push(params).dispatchIndirect(itemArguments);
    }
    if (scene_.needs.emitters) {
        Pass pass = graph_.pass(kernels_.handleEmissiveHits);
        pass.read(rays).read(buffers_.hits).read(buffers_.counters).readWrite(buffers_.radiance);
        readSurfaces(pass, scene_).read(scene_.lights);
        if (cache) gatherForTraining(pass, buffers_.pathStates, *cache);
        pass.push(params).dispatchIndirect(itemArguments);
    }
}

void WavefrontPathTracer::scatter(const gpu::BounceParams& params, const CachePaths* cache) {
    const uint32_t parity = params.queueParity;
    Pass pass = graph_.pass(kernels_.scatter);
    readSurfaces(pass.read(buffers_.rays[parity]).read(buffers_.hits).readWrite(buffers_.counters), scene_)
        .read(scene_.lights)
        .read(scene_.environment)
        .read(scene_.environmentAlias)
        .read(scene_.reflectanceTable)
        .write(buffers_.rays[1 - parity])
        .write(buffers_.shadowRays);
    if (cache)
        gatherForTraining(pass, buffers_.pathStates, *cache)
            .write(cache->queries)
            .write(cache->queryWeights)
            .write(cache->trainingQueries)
            .readWrite(cache->counters)
            .readWrite(buffers_.radiance)
            .push(CachedBounceParams{params, cache->rule});
    else
        pass.push(params);
    pass.dispatchIndirect(BufferRange(buffers_.arguments, gpu::kItemArguments * 4, 12));
}

void WavefrontPathTracer::addDirectLight(const CachePaths* cache) {
    Pass pass = graph_.pass(kernels_.addDirectLight);
    pass.read(buffers_.shadowRays)
        .read(buffers_.visibility)
        .read(buffers_.counters)
        .readWrite(buffers_.radiance);
    if (cache) gatherForTraining(pass, buffers_.pathStates, *cache);
    pass.dispatchIndirect(BufferRange(buffers_.arguments, gpu::kItemArguments * 4, 12));
}

void WavefrontPathTracer::recordSurfaces(const Camera& camera, const Wave& wave) {
    const gpu::SurfaceParams params{
        wave.pixels, wave.log2Samples, 0, 0, glm::vec4(camera.position, 0), glm::vec4(camera.forward, 0)};
    Pass pass = graph_.pass(kernels_.recordSurfaces);
    pass.read(buffers_.rays[0])
        .read(buffers_.hits)
        .readWrite(buffers_.ofPixels(buffers_.surfaces, gpu::kSurfaceVectors, wave.firstPixel, wave.pixels));
    readSurfaces(pass, scene_).push(params).dispatch(wave.pixels);
}

uint64_t WavefrontPathTracer::raysTraced() const {
    // The last bounce's shadow rays are counted by the begin_bounce after them: add what is left over.
    const auto counters = download<uint32_t>(device_, buffers_.counters, gpu::kCounters);
    return uint64_t(counters[gpu::kTracedRays]) + (uint64_t(counters[gpu::kTracedRaysHigh]) << 32) +
           counters[gpu::kShadowRayCounter];
}

FilmImage WavefrontPathTracer::readFilm() const {
    const size_t pixels = size_t(options_.width) * options_.height;
    FilmImage image;
    image.width = static_cast<int>(options_.width);
    image.height = static_cast<int>(options_.height);
    image.frames = frames_;
    image.samplesPerFrame = options_.samplesPerFrame;
    image.reserve(pixels, frames_ >= 2, options_.surfaces);
    const float n = static_cast<float>(frames_);
    forEachPixel<gpu::kFilmVectors>(device_, buffers_.film, [&](const glm::vec4* p) {
        image.mean.emplace_back(p[0]);
        if (frames_ >= 2) image.variance.push_back(glm::vec3(p[1]) / (n * (n - 1.0f)));
    });
    if (!options_.surfaces) return image;
    forEachPixel<gpu::kSurfaceVectors>(device_, buffers_.surfaces, [&](const glm::vec4* s) {
        const float hits = std::max(s[0].w, 1.0f);
        image.albedo.push_back(glm::vec3(s[0]) / hits);
        image.normal.push_back(glm::vec3(s[1]) / hits);
        const glm::dvec3 position = glm::dvec3(glm::vec3(s[2])) / double(hits) + scene_.origin;
        image.position.push_back(s[0].w > 0 ? glm::vec3(position) : glm::vec3(0.0f));
        image.depth.push_back(s[0].w > 0 ? s[1].w / hits : std::numeric_limits<float>::infinity());
    });
    return image;
}

} // namespace irradia
