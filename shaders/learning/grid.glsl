// Levels of a feature grid and the corners about a point (Müller et al. 2022, section 3). Constants and the table of levels
// are set by nrc/learning/encodings/grid.cpp; included after learning/encode.glsl.
#include "lib/encoding.glsl"

layout(constant_id = kConstantOwn) const uint kGridKind = kGridDense;
layout(constant_id = kConstantOwn + 1u) const uint kLevels = 8u;
layout(constant_id = kConstantOwn + 2u) const uint kFeatures = 2u; // of a level: 1, 2, 4, 8 or 16
layout(constant_id = kConstantOwn + 3u) const bool kMean = false;  // over levels; else their values one after the other

layout(set = 0, binding = 2, std140) uniform Levels { GridLevel levels[kMaxGridLevels]; };

const uint kCorners = 1u << kDims;
const uint kLevelQuads = (kFeatures + 3u) / 4u; // that hold the values of a level

float levelShare() { return kMean ? 1.0 / float(kLevels) : 1.0; }

// An invocation's row, and which of several groups of levels is its. Groups come one after the other, each for all rows:
// one or two tables at a time stay in the caches (on lavapipe 15 % less time with 2^15 entries), and its threads, which take
// halves of the work, add to different ones.
uint rowAndGroup(out uint group) {
    uint first = gl_WorkGroupID.x * gl_WorkGroupSize.x;
    for (group = 0u; first >= params.capacity; ++group) first -= params.capacity;
    return first + gl_LocalInvocationID.x;
}

// A grid's position: what is not in the unit cube is moved to its border, NaN to 0.
vec3 gridPosition() {
    vec3 p = vec3(0.0);
    [[unroll]] for (uint d = 0u; d < kDims; ++d) p[d] = x[d] > 0.0 ? min(x[d], 1.0) : 0.0;
    return p;
}

struct Cell {
    uvec3 corner; // lowest
    vec3 weight;  // of the upper corners
};

// Not contracted to a fused multiply-add: sparse grids find the same cells on the host.
Cell cellAt(vec3 position, GridLevel level) {
    precise vec3 p = position * level.scale;
    p += 0.5;
    vec3 cell = floor(p);
    return Cell(uvec3(cell), p - cell);
}

uvec3 cornerOf(Cell cell, uint which) { return cell.corner + (uvec3(which, which >> 1u, which >> 2u) & 1u); }

float cornerWeight(Cell cell, uint which) {
    float weight = 1.0;
    [[unroll]] for (uint d = 0u; d < kDims; ++d)
        weight *= (which >> d & 1u) != 0u ? cell.weight[d] : 1.0 - cell.weight[d];
    return weight;
}

// Entry of a corner in the grid's tables; kAbsentEntry where a sparse grid has none.
uint entryAt(GridLevel level, uvec3 corner) {
    uint index = corner.x + level.stride * (corner.y + level.stride * corner.z);
    if (kGridKind == kGridSparse) return loadWord(entries, level.first + index);
    if (kGridKind == kGridHash) {
        // A dense level has room for the corners below `stride`; those at it share entries (index < 2 size).
        if (level.stride == 0u) index = spatialHash(corner) & (level.size - 1u);
        else index -= index >= level.size ? level.size : 0u;
    }
    return level.first + index;
}
