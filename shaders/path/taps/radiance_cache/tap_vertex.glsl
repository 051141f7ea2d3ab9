// A radiance cache listens: paths ask it and end, and record what it learns from. What a tap provides: taps/none.
#include "shared/cache.h"

QUADS_WRITE(TAP_BINDING + 3, queries);
QUADS_WRITE(TAP_BINDING + 4, queryWeights);
QUADS_WRITE(TAP_BINDING + 5, trainingQueries);
COUNTERS(TAP_BINDING + 6, cacheCounters);
layout(set = 0, binding = TAP_BINDING + 7, std430) buffer Radiance { vec4 radiance[]; };
layout(set = 0, binding = TAP_BINDING + 8, std140) uniform Rule { CacheRule rule; };
#include "path/taps/radiance_cache/cached_path.glsl"

struct Visit {
    bool goesOn;
    bool listens;
    CachedPath path;
};

Visit arrive(bool alive, uint path, uint pixel, Surface s, vec3 view, float rayLength, float pdf, vec3 passage,
             inout vec3 beta) {
    CachedPath c = visitVertex(alive, path, pixel, s, view, rayLength, pdf, passage, beta);
    if (c.counts) radiance[path].a += 1.0;
    return Visit(c.renders || c.trains, c.trains, c);
}

// Past the picture's end only unbiased suffixes play.
float survivalOf(Visit visit, float survival, vec3 throughput) {
    if (visit.path.renders) return survival;
    return (visit.path.flags & kPathUnbiased) != 0u ? min(maxComponent(throughput), 1.0) : 1.0;
}

bool goesOnUnseen(Visit visit, vec3 throughput) { return !visit.path.renders && maxComponent(throughput) > 0.0; }

void leave(Visit visit, vec3 directLight, vec3 throughput) { leaveVertex(visit.path, directLight, throughput); }
