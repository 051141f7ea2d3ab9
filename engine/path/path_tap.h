// Who listens at the vertices of a wave's paths: the host's side of a folder in shaders/path/taps.
#pragma once

#include "engine/graph/frame_graph.h"
#include <optional>
#include <vector>

namespace irradia {

struct PathTap {
    std::vector<PassBinding> light;  // what its tap_light.glsl declares, in that order
    std::vector<PassBinding> vertex; // what its tap_vertex.glsl declares besides
    // Number of the vertex up to which it has paths followed, if the picture's end before; none = no further
    // than these.
    std::optional<uint32_t> lastDepth;
};

} // namespace irradia
