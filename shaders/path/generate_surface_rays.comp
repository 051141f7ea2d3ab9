#version 460
#extension GL_GOOGLE_include_directive : require
// Rays towards points uniform over the area of the scene's surfaces, from directions weighted by the cosine: as they are
// seen from everywhere. What the rays hit is known, and nothing is traced.
#include "lib/kernel.glsl"
#include "lib/rng.glsl"
#include "lib/sampling.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
QUADS_WRITE(1, rays);
QUADS_WRITE(2, hits);
COUNTERS(3, counters);
QUADS_READ(4, geometry);
QUADS_READ(5, attributes);
QUADS_READ(6, materials);
QUADS_READ(7, textures);
HALVES_READ(8, texels);
QUADS_READ(9, areaTable);
QUADS_WRITE(10, passages);
layout(push_constant) uniform Push { WaveParams params; float viewDistance; };
#include "path/scene.glsl"

uint sampleByArea(uvec2 random) {
    uint primitive = uniformIndex(random.x, frame.triangles);
    uvec4 entry = loadQuad(areaTable, primitive);
    return unitFloat(random.y) < uintBitsToFloat(entry.x) ? primitive : entry.y;
}

// The side that is seen: of double-sided materials either, else the front.
float sampleSide(uint material, uint random) {
    uint flags = loadQuad(materials, material * kMaterialQuads + 3u).y;
    return (flags & kMaterialDoubleSided) != 0u && unitFloat(random) < 0.5 ? -1.0 : 1.0;
}

void main() {
    uint path = gl_GlobalInvocationID.x;
    if (path == 0u) counters[kRayCounter] = params.paths;
    if (path >= params.paths) return;
    uvec4 point = randomBits(params.firstPixel + path, params.sampleIndex, kSurfacePointBlock, frame.seed);
    uvec4 view = randomBits(params.firstPixel + path, params.sampleIndex, kSurfaceViewBlock, frame.seed);
    uint primitive = sampleByArea(point.xy);
    vec2 b = sampleTriangle(unitFloats(point).zw);
    TriangleGeometry tri = loadTriangle(primitive);
    vec3 normal = normalize(cross(tri.e1, tri.e2)) * sampleSide(tri.material, view.z);
    vec3 towardsViewer = toWorld(frameFromNormal(normal), sampleCosineHemisphere(unitFloats(view).xy));
    vec3 origin = tri.p0 + b.x * tri.e1 + b.y * tri.e2 + viewDistance * towardsViewer;

    storeQuad(rays, path * kRayQuads, uvec4(floatBitsToUint(origin), path));
    storeQuad(rays, path * kRayQuads + 1u, uvec4(floatBitsToUint(-towardsViewer), 0u));
    storeQuad(rays, path * kRayQuads + 2u, uvec4(floatBitsToUint(vec3(1.0)), 0u));
    storeQuad(hits, path, uvec4(floatBitsToUint(viewDistance), primitive, floatBitsToUint(b)));
    if (kHasTransparency) storeQuad(passages, path, uvec4(floatBitsToUint(vec3(1.0)), 0u)); // outside of all media
}
