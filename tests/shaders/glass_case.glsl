// A transmissive material and a view direction, the input of glass's harness kernels, and what a path's vertex computes
// from them before it evaluates or samples. Bindings: `cases` (4 records each), `reflectanceTable` and `glassTable`.
//   0: base colour rgb, metallic;  1: dielectric f0 rgb (of the material in air), specular factor
//   2: view xyz (local), roughness;  3: eta, transmission, 1 of sheets, ior of the material
#include "faults.glsl"
#include "lib/glass.glsl"
#include "lib/rng.glsl"
#include "path/glass_table.glsl"
#include "path/reflectance.glsl"

struct GlassCase {
    Bsdf bsdf;
    Glass glass;
    GlassView view;
    vec3 v;
    float roughness;
    float mend; // of the view direction
};

GlassCase loadCase(uint index) {
    vec4 c0 = uintBitsToFloat(loadQuad(cases, 4u * index));
    vec4 c1 = uintBitsToFloat(loadQuad(cases, 4u * index + 1u));
    vec4 c2 = uintBitsToFloat(loadQuad(cases, 4u * index + 2u));
    vec4 c3 = uintBitsToFloat(loadQuad(cases, 4u * index + 3u));
    GlassCase c;
    bool isSheet = c3.z > 0.0;
    vec3 f0 = c1.rgb * (isSheet ? 1.0 : pairReflectance(c3.w, c3.x));
    c.bsdf = makeBsdf(c0.rgb, c0.w, c2.w, f0, c1.w);
    c.bsdf.diffuse *= 1.0 - c3.y;
    c.glass = makeGlass(c0.rgb, c0.w, c3.y, f0, c1.w, awayFromOne(c3.x), isSheet);
    c.v = c2.xyz;
    c.roughness = c2.w;
    vec3 abc = reflectanceAt(thinCosine(c.glass, c.v.z), c.roughness);
    c.mend = glassMend(c.bsdf, c.glass, c.v.z, abc);
    c.view = prepareGlass(c.bsdf, c.glass, c.v, abc, c.mend, glassLossesOf(c.glass, c.bsdf.alpha, c.v, abc));
    return c;
}

// mend and 1 - E towards l.
vec2 towards(GlassCase c, vec3 l) {
    float mu = abs(l.z);
    vec3 abc = reflectanceAt(thinCosine(c.glass, mu), c.roughness);
    return vec2(min(c.mend, glassMend(c.bsdf, c.glass, mu, abc)),
                glassLossTowards(c.glass, c.bsdf.alpha, l, abc));
}

BsdfValue evaluateCase(GlassCase c, vec3 l) {
    vec2 t = towards(c, l);
    BsdfValue value = evaluateGlass(c.bsdf, c.glass, c.view, c.v, l, t.x, t.y, false);
    return BsdfValue(kRadianceFault * value.fCos, kPdfFault * value.pdf);
}

vec3 sampleCase(GlassCase c, vec3 u) {
    Bsdf sampled = c.bsdf;
    sampled.alpha *= kAlphaFault;
    GlassView view = c.view;
    view.pDiffuse *= kLobeFault;
    return sampleGlass(sampled, c.glass, view, c.v, u);
}
