#version 460
#extension GL_GOOGLE_include_directive : require
// One camera ray per path of the wave: pinhole or orthographic, box pixel filter.
#include "lib/kernel.glsl"
#include "shared/path.h"
#include "shared/queue.h"

RECORDS_WRITE(0, rays);
layout(set = 0, binding = 1, std430) writeonly buffer Radiance { vec4 radiance[]; };
COUNTERS(2, counters);
layout(push_constant) uniform Push { CameraParams params; };
#include "path/sampler.glsl"
#include "path/wave.glsl"

void main() {
    uint path = gl_GlobalInvocationID.x;
    if (path == 0u) counters[kRayCounter] = params.pathCount;
    if (path >= params.pathCount) return;
    uint pixel = pixelOf(path);
    uint seen = pixel < kFirstTrainingPixel ? pixel : (pixel - kFirstTrainingPixel) % (params.width * params.height);
    uint y = seen / params.width;
    uint x = seen - y * params.width;
    vec4 u = unitFloats(sampleBits(pixel, sampleOf(path), kCameraBlock, params.seed));
    vec2 ndc = vec2(2.0 * (float(x) + u.x) / float(params.width) - 1.0, 1.0 - 2.0 * (float(y) + u.y) / float(params.height));
    vec3 across = ndc.x * params.right.xyz + ndc.y * params.up.xyz;
    bool parallel = params.isOrthographic != 0u;
    vec3 origin = parallel ? params.position.xyz + across : params.position.xyz;
    vec3 direction = parallel ? params.forward.xyz : normalize(params.forward.xyz + across);

    storeRecord(rays, path * kRayRecords, uvec4(floatBitsToUint(origin), path));
    storeRecord(rays, path * kRayRecords + 1u, uvec4(floatBitsToUint(direction), 0u));
    storeRecord(rays, path * kRayRecords + 2u, uvec4(floatBitsToUint(vec3(1.0)), 0u));
    radiance[path] = vec4(0.0);
}
