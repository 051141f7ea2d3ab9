#include "engine/path/ray_source.h"

#include "engine/error.h"
#include "engine/path/scene_bindings.h"
#include "kernels/path.h"

namespace irradia {

CameraRays::CameraRays(Device& device, const GpuScene& scene, const PathTracerOptions& options)
    : kernel_(device, kernels::generate_camera_rays, fittedTo(scene.needs, options)) {}

void CameraRays::generate(FrameGraph& graph, const WaveBuffers& buffers, const Buffer& constants,
                          const gpu::WaveParams& wave) const {
    graph.pass(kernel_)
        .read(constants)
        .write(buffers.rays[0])
        .write(buffers.radiance)
        .readWrite(buffers.counters)
        .push(wave)
        .dispatch(wave.paths);
}

SurfaceRays::SurfaceRays(Device& device, const GpuScene& scene, const PathTracerOptions& options)
    : scene_(scene) {
    if (scene.areaTable)
        kernel_ = Kernel(device, kernels::generate_surface_rays, fittedTo(scene.needs, options));
}

void SurfaceRays::generate(FrameGraph& graph, const WaveBuffers& buffers, const Buffer& constants,
                           const gpu::WaveParams& wave, float distance) const {
    if (!scene_.areaTable) fail(ExitCode::Internal, "the scene was packed without its area table");
    Pass pass = graph.pass(kernel_);
    pass.read(constants).write(buffers.rays[0]).write(buffers.hits).readWrite(buffers.counters);
    readSurfaces(pass, scene_)
        .read(scene_.areaTable)
        .write(buffers.passages)
        .push(gpu::SurfaceRayParams{wave, distance})
        .dispatch(wave.paths);
}

} // namespace irradia
