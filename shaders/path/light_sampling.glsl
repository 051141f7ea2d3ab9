// Light sampling: a point of the light that light_sampler.glsl chooses. Bindings: those of lights/ and `environmentAlias`
// (quads); `frame` is FrameConstants.
#ifndef IRRADIA_PATH_LIGHT_SAMPLING_GLSL
#define IRRADIA_PATH_LIGHT_SAMPLING_GLSL
#include "lib/plane_error.glsl"
#include "path/coverage.glsl"
#include "lib/rng.glsl"
#include "path/lights/environment.glsl"
#include "path/lights/punctual.glsl"
#include "path/lights/triangles.glsl"
#include "path/sampler.glsl"

struct LightSample {
    vec3 direction; // unit, towards the light
    float tMax;     // up to just before it
    vec3 radiance;  // of a punctual light irradiance of what faces it
    float pdf;      // per solid angle (of a punctual light the chance), the choice of the light included; 0 = nothing to add
    bool isPunctual;
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
    return LightSample(directionOfEquirect(uv), kFarAway, environmentRadiance(uv), environmentPdf(uv), false);
}

LightSample sampleTriangleLight(Receiver receiver, uvec4 random, uint primitive, float chance) {
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
    float pdf = abs(cosine) > 1e-6 ? trianglePdf(chance, 0.5 * doubleArea, distance, abs(cosine)) : 0.0;
    vec3 reach = abs(b.x * tri.e1) + abs(b.y * tri.e2);
    float error = pointError(normal, tri.p0, reach, point) + heightError(tri.e1, tri.e2, doubleArea, reach + abs(to));
    return LightSample(direction, lengthBefore(distance, abs(cosine), error), radiance, pdf, false);
}

// Points and spots.
LightSample samplePunctualLight(Receiver receiver, uint index, float chance) {
    PunctualLight light = loadPunctual(index);
    vec3 to = light.place.xyz - receiver.point;
    float distance = length(to);
    vec3 direction = to / max(distance, 1e-30);
    vec3 irradiance = punctualIrradiance(light, distance, -direction);
    float error = kRounding * maxComponent(abs(light.place.xyz)); // no surface that it lies in hides it
    return LightSample(direction, lengthBefore(distance, 1.0, error), irradiance, chance * shareOfLocalLights(), true);
}

LightSample sampleDirectionalLight(uvec4 random) {
    uint index = uniformIndex(random.x, frame.directionalCount);
    PunctualLight light = loadPunctual(index);
    bool isKept = unitFloat(aliasBits(random, frame.directionalCount)) < light.place.w;
    if (!isKept) light = loadPunctual(floatBitsToUint(light.direction.x));
    return LightSample(light.place.xyz, kFarAway, light.intensity.rgb, light.intensity.w * shareOfDirectionalLights(), true);
}

LightSample sampleLocalLight(Receiver receiver, uvec4 random) {
    LightChoice choice = chooseLocalLight(receiver, random);
    uint which = loadQuad(lights, choice.light).z;
    bool isPunctual = (which & kPunctual) != 0u;
    if (!kHasPoints) return sampleTriangleLight(receiver, random, which, choice.chance);
    LightSample a = samplePunctualLight(receiver, isPunctual ? which & ~kPunctual : 0u, choice.chance);
    if (!kHasEmitters) return a;
    LightSample b = sampleTriangleLight(receiver, random, isPunctual ? 0u : which, choice.chance);
    if (isPunctual) return a;
    return b;
}

// One light sample for a vertex: `random` drives it, `choice` in [0, 1) picks the group.
LightSample sampleLight(Receiver receiver, uvec4 random, float choice) {
    LightSample result;
    if (kHasLocal) result = sampleLocalLight(receiver, random);
    if (kHasDirectional) {
        LightSample directional = sampleDirectionalLight(random);
        if (!kHasLocal || choice < shareOfEnvironment() + shareOfDirectionalLights()) result = directional;
    }
    if (kHasEnvironment) {
        LightSample outside = sampleEnvironment(random);
        if (!(kHasLocal || kHasDirectional) || choice < shareOfEnvironment()) result = outside;
    }
    return result;
}

// Of a light sample, per unit of what it would bring: against a density of BSDF sampling by multiple importance sampling,
// unless no BSDF sample finds the light.
float lightWeight(LightSample light, float pdf) {
    return (light.isPunctual ? 1.0 : powerHeuristic(light.pdf, pdf)) / light.pdf;
}

#endif
