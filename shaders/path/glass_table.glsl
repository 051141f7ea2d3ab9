// Look-ups in the table of what rough glass loses. Binding: `glassTable` (quads).
#ifndef IRRADIA_PATH_GLASS_TABLE_GLSL
#define IRRADIA_PATH_GLASS_TABLE_GLSL
#include "lib/glass.glsl"
#include "shared/glass_table.h"

vec4 loadGlass(uint quad) { return uintBitsToFloat(loadQuad(glassTable, quad)); }

// 1 - E at cosine mu, of solid glass whose other side has eta times the index.
float glassLoss(float mu, float alpha, float eta) {
    mu = clamp(mu, 1e-6, 1.0);
    float x = glassColumn(mu, alpha) * float(kGlassCosines - 1u);
    float y = max(glassRow(alpha), 0.0) * float(kGlassAlphas - 1u);
    float z = glassSlice(eta, glassSliceScale(mu, alpha)) * float(kGlassIndices - 1u);
    uint x0 = min(uint(x), kGlassCosines - 2u);
    uint y0 = min(uint(y), kGlassAlphas - 2u);
    uint z0 = min(uint(z), kGlassIndices - 2u);
    uint quad = glassQuad(eta < 1.0 ? 1u : 0u, x0, y0, z0);
    vec4 rows = mix(loadGlass(quad), loadGlass(quad + 1u), x - float(x0));
    vec2 slices = mix(rows.xz, rows.yw, y - float(y0));
    return mix(slices.x, slices.y, z - float(z0));
}

// Its mean over a cosine-weighted hemisphere; of sheets with isSheet.
float glassMeanLoss(float alpha, float eta, bool isSheet) {
    float y = max(glassRow(alpha), 0.0) * float(kGlassMeanAlphas - 1u);
    float z = glassSlice(eta, glassMeanSliceScale(alpha)) * float(kGlassMeanIndices - 1u);
    uint y0 = min(uint(y), kGlassMeanAlphas - 2u);
    uint z0 = min(uint(z), kGlassMeanIndices - 2u);
    vec4 rows = loadGlass(isSheet ? kGlassFirstSheet + y0 : glassMeanQuad(eta < 1.0 ? 1u : 0u, y0, z0));
    vec2 slices = mix(rows.xz, rows.yw, y - float(y0));
    return exp2(isSheet ? slices.x : mix(slices.x, slices.y, z - float(z0)));
}

// 1 - E towards l, on either side; abc is the reflectance table's at thinCosine(|l.z|), which is |l.z| of sheets.
float glassLossTowards(Glass g, float alpha, vec3 l, vec3 abc) {
    float eta = l.z > 0.0 ? g.eta : 1.0 / g.eta;
    return g.isSheet ? max(1.0 - abc.x - abc.y, 0.0) : glassLoss(abs(l.z), alpha, eta);
}

GlassLosses glassLossesOf(Glass g, float alpha, vec3 v, vec3 abc) {
    return GlassLosses(glassLossTowards(g, alpha, v, abc), glassMeanLoss(alpha, g.eta, g.isSheet),
                       square(g.eta) * glassMeanLoss(alpha, 1.0 / g.eta, g.isSheet));
}

#endif
