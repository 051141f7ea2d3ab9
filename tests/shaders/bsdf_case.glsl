// A material and a view direction, the input of the BSDF's harness kernels, and what a path's vertex computes from
// them before it evaluates or samples. Bindings: `cases` (3 records each) and `reflectanceTable` (records).
//   0: base colour rgb, metallic;  1: dielectric f0 rgb, specular factor;  2: view xyz (local), roughness
#include "faults.glsl"
#include "lib/bsdf.glsl"
#include "lib/rng.glsl"
#include "path/reflectance.glsl"

struct BsdfCase {
    Bsdf bsdf;
    vec3 view;
    float roughness;
    float mend; // of the view direction
    float pSpecular;
};

BsdfCase loadCase(uint index) {
    vec4 c0 = uintBitsToFloat(loadQuad(cases, 3u * index));
    vec4 c1 = uintBitsToFloat(loadQuad(cases, 3u * index + 1u));
    vec4 c2 = uintBitsToFloat(loadQuad(cases, 3u * index + 2u));
    BsdfCase c;
    c.bsdf = makeBsdf(c0.rgb, c0.w, c2.w, c1.rgb, c1.w);
    c.view = c2.xyz;
    c.roughness = c2.w;
    vec3 abc = reflectanceAt(c.view.z, c.roughness);
    c.mend = diffuseMend(c.bsdf, abc);
    c.pSpecular = specularProbability(c.bsdf, abc, c.mend);
    return c;
}

float mendTowards(BsdfCase c, vec3 l) {
    return min(c.mend, diffuseMend(c.bsdf, reflectanceAt(l.z, c.roughness)));
}

BsdfValue evaluateCase(BsdfCase c, vec3 l) {
    BsdfValue value = evaluateBsdf(c.bsdf, c.view, l, mendTowards(c, l), c.pSpecular, kHasSpecular);
    return BsdfValue(kRadianceFault * value.fCos, kPdfFault * value.pdf);
}

vec3 sampleCase(BsdfCase c, vec3 u) {
    Bsdf sampled = c.bsdf;
    sampled.alpha *= kAlphaFault;
    return sampleBsdf(sampled, c.view, u, c.pSpecular * kLobeFault, kHasSpecular);
}
