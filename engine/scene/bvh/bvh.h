// The hierarchy that rays are traced through: built with the surface area heuristic, stored as
// shaders/shared/bvh.h says.
#pragma once

#include "engine/scene/scene.h"
#include "shared/bvh.h"
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace irradia {

// The same scene gives the same quads, bit for bit, at any number of threads.
//   - item `root` is a node (of an empty scene: a triangle that no ray hits);
//   - every triangle is in one leaf or more (a long one may be split among boxes);
//   - a decoded child box holds the part of the triangles below it that lies in its ancestors' boxes;
//   - a traversal never holds more than stackNeed groups, and stackNeed < gpu::kTraversalStack (entry 0 is
//   the
//     stack's bottom).
struct Bvh {
    std::vector<glm::uvec4> quads;
    uint32_t root = 0;       // item
    uint32_t nodes = 0;      // inner nodes
    uint32_t references = 0; // triangle items; at least the number of triangles
    uint32_t maxDepth = 0;   // levels of nodes
    uint32_t stackNeed = 0;  // groups
    Bounds bounds;           // of all triangles
};

struct BvhOptions {
    bool median =
        false; // halve at the median: quick, poor to trace; what a tree too deep for the stack falls back to
    uint32_t threads = 0; // of the builder, 0 = all cores
    float splitReferences =
        0.5f; // spatial splits may add this share of references (Stich et al. 2009), 0 = none
};

// Throws Error(BadData) when the quads would not fit the 128 MiB every device can bind.
Bvh buildBvh(const Scene& scene, const BvhOptions& options = {});

} // namespace irradia
