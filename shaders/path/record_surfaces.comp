#version 460
#extension GL_GOOGLE_include_directive : require
// The first hits of each pixel for the AOV layers: albedo, shading normal, position, depth, summed over samples in their order.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "shared/queue.h"

RECORDS_READ(0, rays);
RECORDS_READ(1, hits);
layout(set = 0, binding = 2, std430) buffer Surfaces { vec4 surfaces[]; };
RECORDS_READ(3, geometry);
RECORDS_READ(4, attributes);
RECORDS_READ(5, materials);
RECORDS_READ(6, textures);
HALVES_READ(7, texels);
layout(push_constant) uniform Push { SurfaceParams params; };
#include "path/surface.glsl"

void addHit(uint slot, inout vec4 layers[kSurfaceVectors]) {
    uvec4 hit = loadRecord(hits, slot);
    if (hit.y == kNoPrimitive) return;
    vec3 view = -uintBitsToFloat(loadRecord(rays, slot * kRayRecords + 1u).xyz);
    Surface s = loadSurface(hit.y, uintBitsToFloat(hit.zw), view);
    vec3 albedo = s.bsdf.diffuse + s.bsdf.specularF0;
    float depth = dot(s.position - params.cameraPosition.xyz, params.cameraForward.xyz);
    layers[0] += vec4(albedo, 1.0);
    layers[1] += vec4(s.shadingNormal, depth);
    layers[2] += vec4(s.position, 0.0);
}

// Camera rays stand in the queue in the order of their paths.
void main() {
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= params.pixels) return;
    uint at = pixel * kSurfaceVectors;
    vec4 layers[kSurfaceVectors] = vec4[](surfaces[at], surfaces[at + 1u], surfaces[at + 2u]);
    uint slot = pixel << params.log2Samples, end = slot + (1u << params.log2Samples);
    do addHit(slot, layers);
    while (++slot < end);
    [[unroll]] for (uint i = 0u; i < kSurfaceVectors; ++i) surfaces[at + i] = layers[i];
}
