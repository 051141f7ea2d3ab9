#include "engine/path/wavefront_path_tracer.h"

#include "engine/error.h"
#include "kernels/path.h"
#include "shared/queue.h"
#include "shared/trace.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace irradia {

namespace {

// Paths in flight: on a CPU few enough for the queues to stay in its caches, on a GPU enough to fill it.
constexpr uint32_t kCpuWave = 1u << 15;
constexpr uint32_t kGpuWave = 1u << 20;

// Constants of every kernel that includes path/needs.glsl.
KernelOptions fitted(const SceneNeeds& needs, uint32_t view) {
    KernelOptions options;
    options.constants = {{gpu::kConstantEnvironment, needs.environment},
                         {gpu::kConstantEmitters, needs.emitters},
                         {gpu::kConstantTextures, needs.textures},
                         {gpu::kConstantSpecular, needs.specular},
                         {gpu::kConstantView, view},
                         {gpu::kConstantLightTree, needs.lightTree}};
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

bool startsAtSurfaces(const Wave& wave) {
    return wave.firstPixel >= gpu::kFirstSurfacePath;
}

// `count` paths, at most `largest` a wave.
std::vector<Wave> split(uint32_t first, uint32_t count, uint32_t largest) {
    std::vector<Wave> waves;
    for (uint32_t done = 0; done < count; done += largest)
        waves.push_back({first + done, std::min(largest, count - done)});
    return waves;
}

// scatter's, where there is a cache.
struct CachedBounceParams {
    gpu::BounceParams bounce;
    gpu::CacheRule rule;
};

} // namespace

uint32_t WavefrontPathTracer::largestWave(const Device& device, const PathTracerOptions& options) {
    const uint64_t pixels = uint64_t(options.width) * options.height;
    const uint64_t wanted = options.waveSize != 0 ? options.waveSize : (device.isCpu() ? kCpuWave : kGpuWave);
    return static_cast<uint32_t>(std::min(pixels, wanted));
}

std::vector<Device::PlannedBuffer> WavefrontPathTracer::plannedBuffers(const Device& device,
                                                                       const PathTracerOptions& options) {
    const uint64_t wave = largestWave(device, options);
    const uint64_t pixels = uint64_t(options.width) * options.height;
    return {{"rays", 2 * wave * gpu::kRayRecords * 16},
            {"hits", wave * 16},
            {"shadow rays", wave * (gpu::kShadowRayRecords * 16 + 4)},
            {"path radiance", wave * (options.cached ? 32 : 16)},
            {"film", pixels * 16 * (gpu::kFilmVectors + (options.surfaces ? gpu::kSurfaceVectors : 0))}};
}

WavefrontPathTracer::WavefrontPathTracer(Device& device, const GpuScene& scene,
                                         const PathTracerOptions& options, Profiler* profiler)
    : device_(device)
    , scene_(scene)
    , options_(options)
    , graph_(device, profiler)
    , waveSize_(largestWave(device, options)) {
    const KernelOptions fit = fitted(scene.needs, options.view);
    kernels_.generateCameraRays = Kernel(device, kernels::generate_camera_rays);
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

    const uint64_t wave = waveSize_;
    const uint64_t pixels = uint64_t(options.width) * options.height;
    for (Buffer& rays : rays_) rays = Buffer(device, "ray queue", wave * gpu::kRayRecords * 16);
    hits_ = Buffer(device, "hits", wave * 16);
    shadowRays_ = Buffer(device, "shadow ray queue", wave * gpu::kShadowRayRecords * 16);
    visibility_ = Buffer(device, "visibility", wave * 4);
    pathStates_ = Buffer(device, "path states", options.cached ? wave * 16 : 16);
    radiance_ = Buffer(device, "path radiance", wave * 16);
    counters_ = Buffer(device, "queue counters", gpu::kCounters * 4);
    arguments_ = Buffer(device, "dispatch arguments", gpu::kDispatchArguments * 4);
    film_ = Buffer(device, "film", pixels * gpu::kFilmVectors * 16);
    surfaces_ = Buffer(device, "surfaces", options.surfaces ? pixels * gpu::kSurfaceVectors * 16 : 16);
}

void WavefrontPathTracer::renderFrame(const Camera& camera, uint32_t index) {
    beginFrame();
    for (const Wave& wave : waves()) {
        for (uint32_t k = 0; k < options_.samplesPerFrame; ++k) traceWave(camera, wave, index, k);
        addToFilm(wave);
    }
    graph_.execute();
    endFrame();
}

void WavefrontPathTracer::beginFrame() {
    graph_.fill(counters_, 0);
}

std::vector<Wave> WavefrontPathTracer::waves() const {
    return split(0, options_.width * options_.height, waveSize_);
}

std::vector<Wave> WavefrontPathTracer::surfaceWaves(uint32_t paths) const {
    return split(gpu::kFirstSurfacePath, paths, waveSize_);
}

void WavefrontPathTracer::addToFilm(const Wave& wave) {
    // Of a frame's samples of a pixel the first alone may train.
    const uint32_t samples = options_.view == gpu::kViewTrainingDensity ? 1 : options_.samplesPerFrame;
    const gpu::FilmParams film{wave.firstPixel, wave.paths, frames_, 1.0f / static_cast<float>(samples)};
    graph_.pass(kernels_.updateFilm).read(radiance_).readWrite(film_).push(film).dispatch(wave.paths);
    graph_.cut();
}

void WavefrontPathTracer::endFrame() {
    ++frames_;
}

void WavefrontPathTracer::forgetFilm() {
    if (options_.surfaces) graph_.fill(surfaces_, 0);
    frames_ = 0;
}

void WavefrontPathTracer::traceWave(const Camera& camera, const Wave& wave, uint32_t frame, uint32_t sample,
                                    const CachePaths* cache) {
    const uint32_t sampleIndex = frame * options_.samplesPerFrame + sample;
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
                                   wave.paths,
                                   sampleIndex,
                                   options_.seed,
                                   sample == 0 ? 1u : 0u,
                                   camera.isOrthographic() ? 1u : 0u};
    graph_.pass(kernels_.generateCameraRays)
        .write(rays_[0])
        .write(radiance_)
        .readWrite(counters_)
        .push(params)
        .dispatch(wave.paths);
    const uint32_t last = trains(cache) ? std::max(deepestRay(), cache->rule.lastDepth) : deepestRay();
    for (uint32_t depth = 0; depth <= last; ++depth) {
        bounce(depth, wave, sampleIndex, cache);
        if (depth == 0 && options_.surfaces) recordSurfaces(camera, wave);
    }
}

void WavefrontPathTracer::traceSurfaceWave(const Wave& wave, uint32_t frame, float distance,
                                           const CachePaths& cache) {
    if (!scene_.areaTable) fail(ExitCode::Internal, "the scene was packed without its area table");
    const uint32_t sampleIndex = frame * options_.samplesPerFrame;
    const gpu::SurfacePathParams params{wave.firstPixel,  wave.paths, sampleIndex, options_.seed,
                                        scene_.triangles, distance,   0,           0};
    Pass pass = graph_.pass(kernels_.generateSurfaceRays);
    pass.write(rays_[0]).write(hits_).readWrite(counters_);
    readSurfaces(pass, scene_).read(scene_.areaTable).push(params).dispatch(wave.paths);
    for (uint32_t depth = 0; depth <= cache.rule.lastDepth; ++depth) bounce(depth, wave, sampleIndex, &cache);
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
                                   scene_.rayEpsilon,
                                   parity,
                                   0,
                                   0};
    const bool areTraced = depth > 0 || !startsAtSurfaces(wave);
    beginBounce(parity, areTraced);
    if (areTraced) meetSurfaces(params, cache);
    graph_.cut();
    // The last ray only adds emission. Training paths go on, and the last of their rays end in the cache.
    const bool isLast = depth == deepestRay() && !trains(cache);
    if (isLast || scene_.triangles == 0) return;
    scatter(params, cache);
    graph_.pass(kernels_.intersectShadow)
        .read(scene_.bvh)
        .read(shadowRays_)
        .read(counters_)
        .write(visibility_)
        .push(gpu::TraceParams{gpu::kShadowRayCounter, scene_.bvhRoot})
        .dispatchIndirect(BufferRange(arguments_, gpu::kTraceArguments * 4, 12)); // at most one a ray
    addDirectLight(cache);
    graph_.cut();
}

void WavefrontPathTracer::beginBounce(uint32_t parity, bool areTraced) {
    const gpu::BeginBounceParams begin{parity, kernels_.intersectClosest.workgroupSize() * gpu::kRaysPerLane,
                                       kernels_.scatter.workgroupSize(), areTraced ? 1u : 0u};
    graph_.pass(kernels_.beginBounce)
        .readWrite(counters_)
        .readWrite(arguments_)
        .push(begin)
        .dispatchGroups(1);
}

// The rays' nearest hits, and the light that they meet there or beyond the scene.
void WavefrontPathTracer::meetSurfaces(const gpu::BounceParams& params, const CachePaths* cache) {
    const uint32_t parity = params.queueParity;
    const Buffer& rays = rays_[parity];
    const BufferRange itemArguments(arguments_, gpu::kItemArguments * 4, 12);
    graph_.pass(kernels_.intersectClosest)
        .read(scene_.bvh)
        .read(rays)
        .read(counters_)
        .write(hits_)
        .push(gpu::TraceParams{gpu::kRayCounter + parity, scene_.bvhRoot})
        .dispatchIndirect(BufferRange(arguments_, gpu::kTraceArguments * 4, 12));
    if (scene_.needs.environment) {
        Pass pass = graph_.pass(kernels_.handleEscapedRays);
        pass.read(rays).read(hits_).read(counters_).readWrite(radiance_).read(scene_.environment);
        if (cache) gatherForTraining(pass, pathStates_, *cache);
        pass.push(params).dispatchIndirect(itemArguments);
    }
    if (scene_.needs.emitters) {
        Pass pass = graph_.pass(kernels_.handleEmissiveHits);
        pass.read(rays).read(hits_).read(counters_).readWrite(radiance_);
        readSurfaces(pass, scene_).read(scene_.lights);
        if (cache) gatherForTraining(pass, pathStates_, *cache);
        pass.push(params).dispatchIndirect(itemArguments);
    }
}

void WavefrontPathTracer::scatter(const gpu::BounceParams& params, const CachePaths* cache) {
    const uint32_t parity = params.queueParity;
    Pass pass = graph_.pass(kernels_.scatter);
    readSurfaces(pass.read(rays_[parity]).read(hits_).readWrite(counters_), scene_)
        .read(scene_.lights)
        .read(scene_.environment)
        .read(scene_.environmentAlias)
        .read(scene_.reflectanceTable)
        .write(rays_[1 - parity])
        .write(shadowRays_);
    if (cache)
        gatherForTraining(pass, pathStates_, *cache)
            .write(cache->queries)
            .write(cache->queryWeights)
            .write(cache->trainingQueries)
            .readWrite(cache->counters)
            .readWrite(radiance_)
            .push(CachedBounceParams{params, cache->rule});
    else
        pass.push(params);
    pass.dispatchIndirect(BufferRange(arguments_, gpu::kItemArguments * 4, 12));
}

void WavefrontPathTracer::addDirectLight(const CachePaths* cache) {
    Pass pass = graph_.pass(kernels_.addDirectLight);
    pass.read(shadowRays_).read(visibility_).read(counters_).readWrite(radiance_);
    if (cache) gatherForTraining(pass, pathStates_, *cache);
    pass.dispatchIndirect(BufferRange(arguments_, gpu::kItemArguments * 4, 12));
}

void WavefrontPathTracer::recordSurfaces(const Camera& camera, const Wave& wave) {
    const gpu::SurfaceParams params{
        wave.firstPixel, wave.paths, 0, 0, glm::vec4(camera.position, 0), glm::vec4(camera.forward, 0)};
    readSurfaces(graph_.pass(kernels_.recordSurfaces).read(rays_[0]).read(hits_).readWrite(surfaces_), scene_)
        .push(params)
        .dispatch(wave.paths);
}

uint64_t WavefrontPathTracer::raysTraced() const {
    // The last bounce's shadow rays are counted by the begin_bounce after them: add what is left over.
    const auto counters = download<uint32_t>(device_, counters_, gpu::kCounters);
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
    const auto film = download<glm::vec4>(device_, film_, pixels * gpu::kFilmVectors);
    const float n = static_cast<float>(frames_);
    for (size_t i = 0; i < pixels; ++i) {
        image.mean.emplace_back(film[i * gpu::kFilmVectors]);
        if (frames_ >= 2)
            image.variance.push_back(glm::vec3(film[i * gpu::kFilmVectors + 1]) / (n * (n - 1.0f)));
    }
    if (!options_.surfaces) return image;
    const auto surfaces = download<glm::vec4>(device_, surfaces_, pixels * gpu::kSurfaceVectors);
    for (size_t i = 0; i < pixels; ++i) {
        const glm::vec4* s = &surfaces[i * gpu::kSurfaceVectors];
        const float hits = std::max(s[0].w, 1.0f);
        image.albedo.push_back(glm::vec3(s[0]) / hits);
        image.normal.push_back(glm::vec3(s[1]) / hits);
        image.position.push_back(glm::vec3(s[2]) / hits);
        image.depth.push_back(s[0].w > 0 ? s[1].w / hits : std::numeric_limits<float>::infinity());
    }
    return image;
}

} // namespace irradia
