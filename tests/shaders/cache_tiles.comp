#version 460
#extension GL_GOOGLE_include_directive : require
// Which training path each pixel of each frame has (+ 1), or 0.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "shared/cache.h"
#include "harness.h"

QUADS_READ(0, geometry);
QUADS_READ(1, attributes);
QUADS_READ(2, materials);
QUADS_READ(3, textures);
HALVES_READ(4, texels);
#define TAP_BINDING 5
QUADS_WRITE(8, queries);
QUADS_WRITE(9, queryWeights);
QUADS_WRITE(10, trainingQueries);
COUNTERS(11, cacheCounters);
QUADS_WRITE(12, results);
layout(push_constant) uniform Push { CacheTilesParams harness; };
FrameConstants frame;
WaveParams params; // of this invocation
CacheRule rule;
#include "path/taps/radiance_cache/cached_path.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x, pixels = harness.width * harness.height;
    if (i >= pixels * harness.frames) return;
    params.sampleIndex = i / pixels;
    frame.seed = harness.seed;
    frame.width = harness.width;
    frame.height = harness.height;
    rule.tilesX = harness.tilesX;
    rule.tilesY = harness.tilesY;
    storeQuad(results, i, uvec4(trainingPathOf(0u, i % pixels), 0u, 0u, 0u));
}
