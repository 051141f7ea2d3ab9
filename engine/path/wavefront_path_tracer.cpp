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

uint32_t waveSize(const Device& device, const PathTracerOptions& options) {
    const uint64_t pixels = uint64_t(options.width) * options.height;
    const uint64_t wanted = options.waveSize != 0 ? options.waveSize : (device.isCpu() ? kCpuWave : kGpuWave);
    return static_cast<uint32_t>(std::min(pixels, wanted));
}

// What follows from the scene's needs: constants of every kernel that includes path/needs.glsl.
KernelOptions fitted(const SceneNeeds& needs) {
    KernelOptions options;
    options.constants = {{gpu::kConstantEnvironment, needs.environment},
                         {gpu::kConstantEmitters, needs.emitters},
                         {gpu::kConstantTextures, needs.textures},
                         {gpu::kConstantSpecular, needs.specular}};
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

} // namespace

std::vector<Device::PlannedBuffer> WavefrontPathTracer::plannedBuffers(const Device& device,
                                                                       const PathTracerOptions& options) {
    const uint64_t wave = waveSize(device, options);
    const uint64_t pixels = uint64_t(options.width) * options.height;
    return {{"rays", 2 * wave * gpu::kRayRecords * 16},
            {"hits", wave * 16},
            {"shadow rays", wave * (gpu::kShadowRayRecords * 16 + 4)},
            {"path radiance", wave * 16},
            {"film", pixels * 16 * (gpu::kFilmVectors + (options.surfaces ? gpu::kSurfaceVectors : 0))}};
}

WavefrontPathTracer::WavefrontPathTracer(Device& device, const GpuScene& scene,
                                         const PathTracerOptions& options, Profiler* profiler)
    : device_(device)
    , scene_(scene)
    , options_(options)
    , graph_(device, profiler)
    , waveSize_(waveSize(device, options)) {
    const KernelOptions fit = fitted(scene.needs);
    kernels_.generateCameraRays = Kernel(device, kernels::generate_camera_rays);
    kernels_.beginBounce = Kernel(device, kernels::begin_bounce);
    kernels_.intersectClosest = Kernel(device, kernels::intersect_closest);
    kernels_.handleEscapedRays = Kernel(device, kernels::handle_escaped_rays, fit);
    kernels_.handleEmissiveHits = Kernel(device, kernels::handle_emissive_hits, fit);
    kernels_.recordSurfaces = Kernel(device, kernels::record_surfaces, fit);
    kernels_.scatter = Kernel(device, kernels::scatter, fit);
    kernels_.intersectShadow = Kernel(device, kernels::intersect_shadow);
    kernels_.addDirectLight = Kernel(device, kernels::add_direct_light);
    kernels_.updateFilm = Kernel(device, kernels::update_film);

    const uint64_t wave = waveSize_;
    const uint64_t pixels = uint64_t(options.width) * options.height;
    for (Buffer& rays : rays_) rays = Buffer(device, "ray queue", wave * gpu::kRayRecords * 16);
    hits_ = Buffer(device, "hits", wave * 16);
    shadowRays_ = Buffer(device, "shadow ray queue", wave * gpu::kShadowRayRecords * 16);
    visibility_ = Buffer(device, "visibility", wave * 4);
    radiance_ = Buffer(device, "path radiance", wave * 16);
    counters_ = Buffer(device, "queue counters", gpu::kCounters * 4);
    arguments_ = Buffer(device, "dispatch arguments", gpu::kDispatchArguments * 4);
    film_ = Buffer(device, "film", pixels * gpu::kFilmVectors * 16);
    surfaces_ = Buffer(device, "surfaces", options.surfaces ? pixels * gpu::kSurfaceVectors * 16 : 16);
}

void WavefrontPathTracer::renderFrame(const Camera& camera, uint32_t index) {
    graph_.fill(counters_, 0);
    const uint32_t pixels = options_.width * options_.height;
    for (uint32_t first = 0; first < pixels; first += waveSize_) {
        const uint32_t count = std::min(waveSize_, pixels - first);
        for (uint32_t k = 0; k < options_.samplesPerFrame; ++k)
            traceWave(camera, first, count, index * options_.samplesPerFrame + k, k == 0);
        const gpu::FilmParams film{first, count, frames_,
                                   1.0f / static_cast<float>(options_.samplesPerFrame)};
        graph_.pass(kernels_.updateFilm).read(radiance_).readWrite(film_).push(film).dispatch(count);
        graph_.cut();
    }
    graph_.execute();
    ++frames_;
}

void WavefrontPathTracer::traceWave(const Camera& camera, uint32_t firstPixel, uint32_t pathCount,
                                    uint32_t sampleIndex, bool firstSample) {
    const float scale = std::tan(0.5f * camera.verticalFov);
    const float aspect = static_cast<float>(options_.width) / static_cast<float>(options_.height);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    const gpu::CameraParams params{glm::vec4(camera.position, 0),
                                   glm::vec4(camera.forward, 0),
                                   glm::vec4(right * scale * aspect, 0),
                                   glm::vec4(camera.up * scale, 0),
                                   options_.width,
                                   options_.height,
                                   firstPixel,
                                   pathCount,
                                   sampleIndex,
                                   options_.seed,
                                   firstSample ? 1u : 0u,
                                   0};
    graph_.pass(kernels_.generateCameraRays)
        .write(rays_[0])
        .write(radiance_)
        .readWrite(counters_)
        .push(params)
        .dispatch(pathCount);
    for (uint32_t depth = 0; depth <= options_.maxBounces + 1; ++depth) {
        bounce(depth, firstPixel, sampleIndex);
        if (depth == 0 && options_.surfaces) recordSurfaces(camera, firstPixel, pathCount);
    }
}

void WavefrontPathTracer::bounce(uint32_t depth, uint32_t firstPixel, uint32_t sampleIndex) {
    const uint32_t parity = depth & 1u;
    const Buffer& rays = rays_[parity];
    const BufferRange traceArguments(arguments_, gpu::kTraceArguments * 4, 12);
    const BufferRange itemArguments(arguments_, gpu::kItemArguments * 4, 12);
    const gpu::BounceParams params{depth,
                                   firstPixel,
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
    const gpu::BeginBounceParams begin{parity, kernels_.intersectClosest.workgroupSize() * gpu::kRaysPerLane,
                                       kernels_.scatter.workgroupSize(), 0};

    graph_.pass(kernels_.beginBounce)
        .readWrite(counters_)
        .readWrite(arguments_)
        .push(begin)
        .dispatchGroups(1);
    graph_.pass(kernels_.intersectClosest)
        .read(scene_.bvh)
        .read(rays)
        .read(counters_)
        .write(hits_)
        .push(gpu::TraceParams{gpu::kRayCounter + parity, scene_.bvhRoot})
        .dispatchIndirect(traceArguments);
    if (scene_.needs.environment)
        graph_.pass(kernels_.handleEscapedRays)
            .read(rays)
            .read(hits_)
            .read(counters_)
            .readWrite(radiance_)
            .read(scene_.environment)
            .push(params)
            .dispatchIndirect(itemArguments);
    if (scene_.needs.emitters)
        readSurfaces(graph_.pass(kernels_.handleEmissiveHits)
                         .read(rays)
                         .read(hits_)
                         .read(counters_)
                         .readWrite(radiance_),
                     scene_)
            .read(scene_.lights)
            .push(params)
            .dispatchIndirect(itemArguments);
    graph_.cut();
    // The last ray only adds emission.
    if (depth == options_.maxBounces + 1 || scene_.triangles == 0) return;

    readSurfaces(graph_.pass(kernels_.scatter).read(rays).read(hits_).readWrite(counters_), scene_)
        .read(scene_.lights)
        .read(scene_.environment)
        .read(scene_.environmentAlias)
        .read(scene_.reflectanceTable)
        .write(rays_[1 - parity])
        .write(shadowRays_)
        .push(params)
        .dispatchIndirect(itemArguments);
    graph_.pass(kernels_.intersectShadow)
        .read(scene_.bvh)
        .read(shadowRays_)
        .read(counters_)
        .write(visibility_)
        .push(gpu::TraceParams{gpu::kShadowRayCounter, scene_.bvhRoot})
        .dispatchIndirect(traceArguments); // at most one shadow ray a ray
    graph_.pass(kernels_.addDirectLight)
        .read(shadowRays_)
        .read(visibility_)
        .read(counters_)
        .readWrite(radiance_)
        .dispatchIndirect(itemArguments);
    graph_.cut();
}

void WavefrontPathTracer::recordSurfaces(const Camera& camera, uint32_t firstPixel, uint32_t pathCount) {
    const gpu::SurfaceParams params{
        firstPixel, pathCount, 0, 0, glm::vec4(camera.position, 0), glm::vec4(camera.forward, 0)};
    readSurfaces(graph_.pass(kernels_.recordSurfaces).read(rays_[0]).read(hits_).readWrite(surfaces_), scene_)
        .push(params)
        .dispatch(pathCount);
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
