#version 460
#extension GL_GOOGLE_include_directive : require
// One camera ray per path of the wave: pinhole or orthographic, box pixel filter.
#include "lib/kernel.glsl"
#include "path/frame.glsl"
#include "shared/queue.h"

FRAME_CONSTANTS(0);
QUADS_WRITE(1, rays);
layout(set = 0, binding = 2, std430) writeonly buffer Radiance { vec4 radiance[]; };
COUNTERS(3, counters);
layout(push_constant) uniform Push { WaveParams params; };
#include "path/sampler.glsl"
#include "path/wave.glsl"

void main() {
    uint path = gl_GlobalInvocationID.x;
    if (path == 0u) counters[kRayCounter] = params.paths;
    if (path >= params.paths) return;
    uint pixel = pixelOf(path);
    uint seen = pixel < kFirstTrainingPixel ? pixel : (pixel - kFirstTrainingPixel) % (frame.width * frame.height);
    uint y = seen / frame.width;
    uint x = seen - y * frame.width;
    vec4 u = unitFloats(sampleBits(pixel, sampleOf(path), kCameraBlock, frame.seed));
    vec2 ndc = vec2(2.0 * (float(x) + u.x) / float(frame.width) - 1.0, 1.0 - 2.0 * (float(y) + u.y) / float(frame.height));
    vec3 across = ndc.x * camera.right.xyz + ndc.y * camera.up.xyz;
    bool parallel = camera.position.w != 0.0;
    vec3 origin = parallel ? camera.position.xyz + across : camera.position.xyz;
    vec3 direction = parallel ? camera.forward.xyz : normalize(camera.forward.xyz + across);

    storeQuad(rays, path * kRayQuads, uvec4(floatBitsToUint(origin), path));
    storeQuad(rays, path * kRayQuads + 1u, uvec4(floatBitsToUint(direction), 0u));
    storeQuad(rays, path * kRayQuads + 2u, uvec4(floatBitsToUint(vec3(1.0)), 0u));
    radiance[path] = vec4(0.0);
}
