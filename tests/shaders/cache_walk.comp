#version 460
#extension GL_GOOGLE_include_directive : require
// Paths whose vertices are given, as scatter and those who gather light lead them past the cache.
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
QUADS_READ(12, vertices); // kWalkVertexQuads each, those of a path side by side
layout(push_constant) uniform Push { CacheRule rule; CacheWalkParams harness; };
FrameConstants frame;
WaveParams params; // of this step
#include "path/taps/radiance_cache/cached_path.glsl"

vec4 part(uint vertex, uint index) { return uintBitsToFloat(loadQuad(vertices, vertex * kWalkVertexQuads + index)); }

void main() {
    uint path = gl_GlobalInvocationID.x;
    bool alive = path < harness.paths;
    uint first = min(path, harness.paths - 1u) * harness.depths; // all lanes stay for the ballots
    vec3 beta = vec3(1.0);
    params.sampleIndex = harness.sampleIndex;
    frame.seed = harness.seed;
    frame.width = harness.width;
    frame.height = 1u;
    for (params.depth = 0u; params.depth < harness.depths; ++params.depth) {
        uint v = first + params.depth;
        Surface s;
        s.position = part(v, 0u).xyz;
        s.geometricNormal = part(v, 2u).xyz;
        s.shadingNormal = part(v, 3u).xyz;
        s.roughness = part(v, 2u).w;
        s.bsdf.alpha = part(v, 3u).w;
        s.bsdf.diffuse = part(v, 4u).rgb;
        s.bsdf.specularF0 = part(v, 5u).rgb;
        CachedPath c = visitVertex(alive, path, path, s, part(v, 1u).xyz, part(v, 0u).w, part(v, 1u).w, vec3(1.0), beta);
        alive = c.renders || c.trains;
        leaveVertex(c, part(v, 7u).rgb, part(v, 6u).rgb);
        if (alive) hearDirectLight(path, vec3(1.0));
        alive = alive && floatBitsToUint(part(v, 4u).w) != 0u;
        if (alive) hearEmission(path, part(v, 8u).rgb);
        beta *= part(v, 6u).rgb;
    }
}
