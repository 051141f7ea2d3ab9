#include "engine/path/bounces.h"

#include "engine/path/scene_bindings.h"
#include "kernels/path.h"
#include "shared/queue.h"
#include "shared/trace.h"

namespace irradia {

Bounces::Bounces(Device& device, const GpuScene& scene, const PathTracerOptions& options,
                 const WaveBuffers& buffers, const Buffer& constants)
    : scene_(scene)
    , buffers_(buffers)
    , constants_(constants)
    , traceArguments_(buffers.arguments, gpu::kTraceArguments * 4, 12)
    , itemArguments_(buffers.arguments, gpu::kItemArguments * 4, 12)
    , begin_(device, kernels::begin_bounce) {
    const KernelOptions fit = fittedTo(scene.needs, options);
    if (scene.needs.transparency) {
        intersectClosest_ = Kernel(device, kernels::intersect_closest_transparent, fit);
        intersectShadow_ = Kernel(device, kernels::intersect_shadow_transparent, fit);
    } else {
        intersectClosest_ = Kernel(device, kernels::intersect_closest);
        intersectShadow_ = Kernel(device, kernels::intersect_shadow);
    }
    handleEscapedRays_ = Kernel(device, *options.kernels.handleEscapedRays, fit);
    handleEmissiveHits_ = Kernel(device, *options.kernels.handleEmissiveHits, fit);
    scatter_ = Kernel(device, *options.kernels.scatter, fit);
    addDirectLight_ = Kernel(device, scene.needs.transparency ? *options.kernels.addFilteredLight
                                                              : *options.kernels.addDirectLight);
}

void Bounces::add(FrameGraph& graph, const gpu::WaveParams& params, bool areTraced, bool scatters,
                  const PathTap* tap) const {
    begin(graph, params, areTraced);
    if (areTraced) {
        intersect(graph, params);
        if (scene_.needs.environment) handleEscapedRays(graph, params, tap);
        if (scene_.needs.emitters) handleEmissiveHits(graph, params, tap);
    }
    graph.cut();
    if (!scatters || scene_.triangles == 0) return;
    scatter(graph, params, tap);
    connect(graph, params, tap);
    graph.cut();
}

void Bounces::begin(FrameGraph& graph, const gpu::WaveParams& params, bool areTraced) const {
    const gpu::BeginBounceParams begin{params.queueParity,
                                       intersectClosest_.workgroupSize() * gpu::kRaysPerLane,
                                       scatter_.workgroupSize(), areTraced ? 1u : 0u};
    graph.pass(begin_)
        .readWrite(buffers_.counters)
        .readWrite(buffers_.arguments)
        .push(begin)
        .dispatchGroups(1);
}

void Bounces::intersect(FrameGraph& graph, const gpu::WaveParams& params) const {
    Pass pass = graph.pass(intersectClosest_);
    pass.read(scene_.bvh)
        .read(buffers_.rays[params.queueParity])
        .read(buffers_.counters)
        .write(buffers_.hits);
    if (scene_.needs.transparency) readSurfaces(pass.read(constants_).readWrite(buffers_.passages), scene_);
    pass.push(gpu::TraceParams{gpu::kRayCounter + params.queueParity, scene_.bvhRoot, params})
        .dispatchIndirect(traceArguments_);
}

// Of what a ray has met, light for its path: what kernels of that kind bind first.
Pass Bounces::handling(FrameGraph& graph, const Kernel& kernel, const gpu::WaveParams& params) const {
    Pass pass = graph.pass(kernel);
    pass.read(constants_)
        .read(buffers_.rays[params.queueParity])
        .read(buffers_.hits)
        .read(buffers_.counters)
        .readWrite(buffers_.radiance);
    return pass;
}

void Bounces::handleEscapedRays(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const {
    Pass pass = handling(graph, handleEscapedRays_, params);
    pass.read(scene_.lights).read(scene_.environment).read(buffers_.passages);
    if (tap) pass.bind(tap->light);
    pass.push(params).dispatchIndirect(itemArguments_);
}

void Bounces::handleEmissiveHits(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const {
    Pass pass = handling(graph, handleEmissiveHits_, params);
    readSurfaces(pass, scene_).read(scene_.lights).read(buffers_.passages);
    if (tap) pass.bind(tap->light);
    pass.push(params).dispatchIndirect(itemArguments_);
}

void Bounces::scatter(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const {
    Pass pass = graph.pass(scatter_);
    pass.read(constants_)
        .read(buffers_.rays[params.queueParity])
        .read(buffers_.hits)
        .readWrite(buffers_.counters);
    readLights(readSurfaces(pass, scene_), scene_)
        .read(scene_.reflectanceTable)
        .write(buffers_.rays[1 - params.queueParity])
        .write(buffers_.shadowRays)
        .readWrite(buffers_.passages)
        .read(scene_.glassTable);
    if (tap) pass.bind(tap->light).bind(tap->vertex);
    pass.push(params).dispatchIndirect(itemArguments_);
}

// The light samples: there is at most one a ray.
void Bounces::connect(FrameGraph& graph, const gpu::WaveParams& params, const PathTap* tap) const {
    Pass shadow = graph.pass(intersectShadow_);
    shadow.read(scene_.bvh).read(buffers_.shadowRays).read(buffers_.counters).write(buffers_.visibility);
    if (scene_.needs.transparency) readSurfaces(shadow, scene_);
    shadow.push(gpu::TraceParams{gpu::kShadowRayCounter, scene_.bvhRoot, params})
        .dispatchIndirect(traceArguments_);
    Pass pass = graph.pass(addDirectLight_);
    pass.read(buffers_.shadowRays)
        .read(buffers_.visibility)
        .read(buffers_.counters)
        .readWrite(buffers_.radiance);
    if (tap) pass.bind(tap->light);
    pass.dispatchIndirect(itemArguments_);
}

} // namespace irradia
