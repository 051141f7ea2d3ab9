// The environment as a light: its radiance, and its density under light sampling. Bindings: `environment` (quads) and those
// of light_sampler.glsl, which says how often the environment is sampled; `frame` is FrameConstants.
#ifndef IRRADIA_PATH_LIGHTS_ENVIRONMENT_GLSL
#define IRRADIA_PATH_LIGHTS_ENVIRONMENT_GLSL
#include "lib/sampling.glsl"
#include "light_sampler.glsl"

uvec4 loadEnvironment(int x, int y) {
    int w = int(frame.environmentWidth);
    int wrapped = x < 0 ? x + w : (x >= w ? x - w : x);
    return loadQuad(environment, clamp(y, 0, int(frame.environmentHeight) - 1) * w + clamp(wrapped, 0, w - 1));
}

// Radiance at equirectangular (u, v), bilinear at texel centres.
vec3 environmentRadiance(vec2 uv) {
    vec2 x = uv * vec2(frame.environmentWidth, frame.environmentHeight) - 0.5;
    vec2 corner = floor(x);
    vec2 f = x - corner;
    ivec2 i = ivec2(corner);
    vec3 top = mix(uintBitsToFloat(loadEnvironment(i.x, i.y).rgb), uintBitsToFloat(loadEnvironment(i.x + 1, i.y).rgb), f.x);
    vec3 bottom = mix(uintBitsToFloat(loadEnvironment(i.x, i.y + 1).rgb),
                      uintBitsToFloat(loadEnvironment(i.x + 1, i.y + 1).rgb), f.x);
    return mix(top, bottom, f.y);
}

// Density per solid angle of sampling the direction at (u, v): d omega = 2 pi^2 sin(theta) du dv.
float environmentPdf(vec2 uv) {
    ivec2 i = ivec2(uv * vec2(frame.environmentWidth, frame.environmentHeight));
    float density = uintBitsToFloat(loadEnvironment(i.x, min(i.y, int(frame.environmentHeight) - 1)).w);
    return density / (2.0 * kPi * kPi * max(sin(uv.y * kPi), 1e-6)) * shareOfEnvironment();
}

#endif
