#version 460
#extension GL_GOOGLE_include_directive : require
// The first hit of each path for the AOV layers: albedo, shading normal, position, depth, summed over samples.
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

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= params.pathCount) return;
    uvec4 hit = loadRecord(hits, slot);
    if (hit.y == kNoPrimitive) return;
    uint path = loadRecord(rays, slot * kRayRecords).w;
    vec3 view = -uintBitsToFloat(loadRecord(rays, slot * kRayRecords + 1u).xyz);
    Surface s = loadSurface(hit.y, uintBitsToFloat(hit.zw), view);
    vec3 albedo = s.bsdf.diffuse + s.bsdf.specularF0;
    float depth = dot(s.position - params.cameraPosition.xyz, params.cameraForward.xyz);
    uint at = (params.firstPixel + path) * kSurfaceVectors;
    surfaces[at] += vec4(albedo, 1.0);
    surfaces[at + 1u] += vec4(s.shadingNormal, depth);
    surfaces[at + 2u] += vec4(s.position, 0.0);
}
