// Light sampling: a point of the light that light_sampler.glsl chooses. Bindings: those of lights/ and `environmentAlias`
// (quads); `frame` is FrameConstants.
#ifndef IRRADIA_PATH_LIGHT_SAMPLING_GLSL
#define IRRADIA_PATH_LIGHT_SAMPLING_GLSL
#include "lib/plane_error.glsl"
#include "path/coverage.glsl"
#include "lib/rng.glsl"
#include "path/lights/environment.glsl"
#include "path/lights/triangles.glsl"
#include "path/sampler.glsl"

struct LightSample {
    vec3 direction; // unit, towards the light
    float tMax;     // up to just before it
    vec3 radiance;
    float pdf;      // per solid angle, the choice of the light included; 0 = nothing to add
};

const float kFarAway = 1e30;

// By its texels, through an alias table: constant time whatever their number.
LightSample sampleEnvironment(uvec4 random) {
    uint count = frame.environmentWidth * frame.environmentHeight;
    uint texel = uniformIndex(random.x, count);
    uvec4 entry = loadQuad(environmentAlias, texel);
    texel = unitFloat(aliasBits(random, count)) < uintBitsToFloat(entry.x) ? texel : entry.y;
    uint row = texel / frame.environmentWidth;
    uint column = texel - row * frame.environmentWidth;
    vec2 uv = (vec2(column, row) + vec2(unitFloat(random.z), unitFloat(random.w))) /
              vec2(frame.environmentWidth, frame.environmentHeight);
    return LightSample(directionOfEquirect(uv), kFarAway, environmentRadiance(uv), environmentPdf(uv));
}

LightSample sampleTriangleLight(Receiver receiver, uvec4 random) {
    LightChoice choice = chooseTriangleLight(receiver, random);
    uint primitive = loadQuad(lights, choice.light).z;
    TriangleGeometry tri = loadTriangle(primitive);
    vec2 b = sampleTriangle(vec2(unitFloat(random.z), unitFloat(random.w)));
    vec3 point = tri.p0 + b.x * tri.e1 + b.y * tri.e2;
    vec3 to = point - receiver.point;
    float distance = length(to);
    vec3 direction = to / max(distance, 1e-30);
    vec3 normal = cross(tri.e1, tri.e2);
    float doubleArea = length(normal);
    normal /= doubleArea;
    float cosine = -dot(normal, direction); // > 0: seen from the front
    TriangleAttributes a = attributesFor(kEmissionAttributes, primitive, b);
    vec3 radiance = emittedRadiance(tri.material, cosine > 0.0, a);
    if (kHasTransparency) radiance *= coverageOf(tri.material, a);
    float pdf = abs(cosine) > 1e-6 ? trianglePdf(choice.chance, 0.5 * doubleArea, distance, abs(cosine)) : 0.0;
    vec3 reach = abs(b.x * tri.e1) + abs(b.y * tri.e2);
    float error = pointError(normal, tri.p0, reach, point) + heightError(tri.e1, tri.e2, doubleArea, reach + abs(to));
    return LightSample(direction, lengthBefore(distance, abs(cosine), error), radiance, pdf);
}

// One light sample for a vertex: `random` drives it, `choice` in [0, 1) picks the environment or the triangles.
LightSample sampleLight(Receiver receiver, uvec4 random, float choice) {
    if (kHasEnvironment && kHasEmitters) {
        LightSample a = sampleEnvironment(random);
        LightSample b = sampleTriangleLight(receiver, random);
        if (choice < shareOfEnvironment()) return a;
        return b;
    }
    if (kHasEnvironment) return sampleEnvironment(random);
    return sampleTriangleLight(receiver, random);
}

#endif
