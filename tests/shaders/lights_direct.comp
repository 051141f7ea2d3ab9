#version 460
#extension GL_GOOGLE_include_directive : require
#pragma folders path/light_samplers/power_or_tree
// Direct light at one point: sums of the estimates by light sampling, by BSDF sampling, and by both with multiple
// importance sampling, as the path tracer combines them.
#include "lib/kernel.glsl"
#include "lib/bsdf.glsl"
#include "shared/path.h"
#include "harness.h"
#include "light_scene.glsl"

QUADS_READ(8, reflectanceTable);
QUADS_WRITE(9, sums); // 3 each, one for each strategy: light sampling, BSDF sampling, both
#include "path/reflectance.glsl"

struct Vertex {
    Frame local;
    vec3 view;
    Bsdf bsdf;
    float roughness;
    float mend;
    float pSpecular;
};

Vertex shadedPoint() {
    Vertex x;
    x.local = frameFromNormal(harness.normal.xyz);
    x.view = toLocal(x.local, harness.view.xyz);
    x.roughness = harness.normal.w;
    x.bsdf = makeBsdf(vec3(0.8, 0.6, 0.4), harness.view.w, x.roughness, vec3(0.04), 1.0);
    vec3 abc = reflectanceAt(x.view.z, x.roughness);
    x.mend = diffuseMend(x.bsdf, abc);
    x.pSpecular = specularProbability(x.bsdf, abc, x.mend);
    return x;
}

BsdfValue evaluateVertex(Vertex x, vec3 l) {
    float mend = min(x.mend, diffuseMend(x.bsdf, reflectanceAt(l.z, x.roughness)));
    return evaluateBsdf(x.bsdf, x.view, l, mend, x.pSpecular, kHasSpecular);
}

// What comes from a direction, and the density of light sampling to find it.
struct Incident {
    vec3 radiance;
    float pdf;
};

Incident incidentFrom(vec3 direction) {
    LightHit hit = castRay(harness.origin.xyz, direction);
    if (hit.t == kFarAway) {
        if (!kHasEnvironment) return Incident(vec3(0.0), 0.0);
        vec2 uv = equirectOfDirection(direction);
        return Incident(environmentRadiance(uv), environmentPdf(uv) * kPdfFault);
    }
    TriangleGeometry tri = loadTriangle(hit.primitive);
    if (tri.light == kNoLight) return Incident(vec3(0.0), 0.0);
    bool front = dot(cross(tri.e1, tri.e2), direction) < 0.0;
    vec3 radiance = emittedRadiance(tri.material, front, attributesFor(kEmissionAttributes, hit.primitive, hit.b));
    return Incident(radiance, hitPdf(hit, direction) * kPdfFault);
}

void main() {
    uint item = gl_GlobalInvocationID.x;
    if (item >= harness.count) return;
    Vertex x = shadedPoint();
    vec3 byLight = vec3(0.0);
    vec3 byBsdf = vec3(0.0);
    vec3 byBoth = vec3(0.0);
    for (uint k = 0u; k < harness.samples; ++k) {
        LightSample light = sampleLightFor(item, k);
        vec3 l = toLocal(x.local, light.direction);
        if (l.z > 0.0 && light.pdf > 0.0 && castRay(harness.origin.xyz, light.direction).t >= light.tMax) {
            BsdfValue value = evaluateVertex(x, l);
            vec3 estimate = value.fCos * light.radiance / light.pdf;
            byLight += estimate;
            byBoth += estimate * powerHeuristic(light.pdf, value.pdf);
        }
        vec4 u = unitFloats(randomBits(item, k, bsdfBlock(0u), frame.seed));
        l = sampleBsdf(x.bsdf, x.view, u.xyz, x.pSpecular, kHasSpecular);
        if (l.z > 0.0) {
            BsdfValue value = evaluateVertex(x, l);
            Incident incident = incidentFrom(toWorld(x.local, l));
            vec3 estimate = value.fCos * incident.radiance / value.pdf;
            byBsdf += estimate;
            byBoth += estimate * powerHeuristic(value.pdf, incident.pdf);
        }
    }
    storeQuad(sums, 3u * item, floatBitsToUint(vec4(byLight * kRadianceFault, 0.0)));
    storeQuad(sums, 3u * item + 1u, floatBitsToUint(vec4(byBsdf * kRadianceFault, 0.0)));
    storeQuad(sums, 3u * item + 2u, floatBitsToUint(vec4(byBoth * kRadianceFault, 0.0)));
}
