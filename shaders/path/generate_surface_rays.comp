#version 460
#extension GL_GOOGLE_include_directive : require
// Rays towards points uniform over the area of the scene's surfaces, from directions weighted by the cosine: as they are
// seen from everywhere. What the rays hit is known, and nothing is traced.
#include "lib/kernel.glsl"
#include "lib/rng.glsl"
#include "lib/sampling.glsl"
#include "shared/path.h"
#include "shared/queue.h"

RECORDS_WRITE(0, rays);
RECORDS_WRITE(1, hits);
COUNTERS(2, counters);
RECORDS_READ(3, geometry);
RECORDS_READ(4, attributes);
RECORDS_READ(5, materials);
RECORDS_READ(6, textures);
HALVES_READ(7, texels);
RECORDS_READ(8, areaTable);
layout(push_constant) uniform Push { SurfacePathParams params; };
#include "path/scene.glsl"

uint sampleByArea(uvec2 random) {
    uint primitive = uniformIndex(random.x, params.triangles);
    uvec4 entry = loadRecord(areaTable, primitive);
    return unitFloat(random.y) < uintBitsToFloat(entry.x) ? primitive : entry.y;
}

// The side that is seen: of double-sided materials either, else the front.
float sampleSide(uint material, uint random) {
    uint flags = loadRecord(materials, material * kMaterialRecords + 3u).y;
    return (flags & kMaterialDoubleSided) != 0u && unitFloat(random) < 0.5 ? -1.0 : 1.0;
}

void main() {
    uint path = gl_GlobalInvocationID.x;
    if (path == 0u) counters[kRayCounter] = params.pathCount;
    if (path >= params.pathCount) return;
    uvec4 point = randomBits(params.firstPath + path, params.sampleIndex, kSurfacePointBlock, params.seed);
    uvec4 view = randomBits(params.firstPath + path, params.sampleIndex, kSurfaceViewBlock, params.seed);
    uint primitive = sampleByArea(point.xy);
    vec2 b = sampleTriangle(unitFloats(point).zw);
    TriangleRecord tri = loadTriangle(primitive);
    vec3 normal = normalize(cross(tri.e1, tri.e2)) * sampleSide(tri.material, view.z);
    vec3 towardsViewer = toWorld(frameFromNormal(normal), sampleCosineHemisphere(unitFloats(view).xy));
    vec3 origin = tri.p0 + b.x * tri.e1 + b.y * tri.e2 + params.distance * towardsViewer;

    storeRecord(rays, path * kRayRecords, uvec4(floatBitsToUint(origin), path));
    storeRecord(rays, path * kRayRecords + 1u, uvec4(floatBitsToUint(-towardsViewer), 0u));
    storeRecord(rays, path * kRayRecords + 2u, uvec4(floatBitsToUint(vec3(1.0)), 0u));
    storeRecord(hits, path, uvec4(floatBitsToUint(params.distance), primitive, floatBitsToUint(b)));
}
