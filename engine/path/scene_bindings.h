// How kernels get at a scene: what they bind of it, and the constants that leave out what it does not need.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/path_tracer_options.h"
#include "engine/scene/gpu_scene.h"

namespace irradia {

// Constants of every kernel that includes path/needs.glsl.
KernelOptions fittedTo(const SceneNeeds& needs, const PathTracerOptions& options);

// What path/scene.glsl reads, in its order.
Pass& readSurfaces(Pass& pass, const GpuScene& scene);

// What path/light_sampling.glsl reads beside the surfaces.
Pass& readLights(Pass& pass, const GpuScene& scene);

} // namespace irradia
