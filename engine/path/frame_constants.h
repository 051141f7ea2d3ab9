// The uniform buffer of a frame: what all of its waves share (shaders/path/frame.glsl).
#pragma once

#include "engine/path/path_tracer_options.h"
#include "engine/scene/gpu_scene.h"

namespace irradia {

struct FrameUniforms {
    gpu::FrameConstants frame;
    gpu::CameraConstants camera;
};

FrameUniforms frameUniforms(const GpuScene& scene, const PathTracerOptions& options, const Camera& camera);

} // namespace irradia
