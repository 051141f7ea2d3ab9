// The scene's bindings 0 to 7 and ray casting without a hierarchy, for the harness kernels of light sampling.
QUADS_READ(0, geometry);
QUADS_READ(1, attributes);
QUADS_READ(2, materials);
QUADS_READ(3, textures);
HALVES_READ(4, texels);
QUADS_READ(5, lights);
QUADS_READ(6, environment);
QUADS_READ(7, environmentAlias);
layout(push_constant) uniform Push {
    FrameConstants frame;
    LightHarnessParams harness;
};
#include "path/light_sampling.glsl"

// Planted faults: 1 leaves the code as it is.
layout(constant_id = 40) const float kRadianceFault = 1.0;
layout(constant_id = 41) const float kPdfFault = 1.0; // factor of light sampling's density

struct LightHit {
    float t; // kFarAway: nothing was hit
    uint primitive;
    vec2 b;
};

// Moller and Trumbore 1997.
LightHit castRay(vec3 origin, vec3 direction) {
    LightHit hit = LightHit(kFarAway, 0u, vec2(0.0));
    for (uint i = 0u; i < harness.triangleCount; ++i) {
        TriangleGeometry tri = loadTriangle(i);
        vec3 p = cross(direction, tri.e2);
        float determinant = dot(p, tri.e1);
        vec3 s = origin - tri.p0;
        vec3 q = cross(s, tri.e1);
        vec2 b = vec2(dot(s, p), dot(direction, q)) / determinant;
        float t = dot(tri.e2, q) / determinant;
        if (min(b.x, b.y) >= 0.0 && b.x + b.y <= 1.0 && t > 0.0 && t < hit.t) hit = LightHit(t, i, b);
    }
    return hit;
}

Receiver harnessReceiver() { return Receiver(harness.origin.xyz, harness.normal.xyz); }

// The density that a hit finds for light sampling, as handle_emissive_hits computes it.
float hitPdf(LightHit hit, vec3 direction) {
    TriangleGeometry tri = loadTriangle(hit.primitive);
    vec3 normal = cross(tri.e1, tri.e2);
    float doubleArea = length(normal);
    float chance = lightChance(tri.light, harnessReceiver());
    return trianglePdf(chance, 0.5 * doubleArea, hit.t, abs(dot(normal, direction)) / doubleArea);
}

LightSample sampleLightFor(uint item, uint index) {
    uvec4 random = randomBits(item, index, lightBlock(0u), frame.seed);
    uint choice = randomBits(item, index, lightChoiceBlock(0u), frame.seed).x;
    LightSample light = sampleLight(harnessReceiver(), random, unitFloat(choice));
    light.pdf *= kPdfFault;
    return light;
}
