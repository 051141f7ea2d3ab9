// The table of what rough glass loses (engine/scene/glass_table): L = 1 - E, where E(mu, alpha, eta) is the share of the
// light from a direction of cosine mu that white glass reflects or refracts at once, by single scattering. eta is the index
// on the far side over that on the side of mu; eta < 1 is the inside, "dense". Per side a grid of
//   column  x = (sqrt(mu) + sqrt(mu (1 + 4 alpha) / (mu + 4 alpha))) / 2,
//   row     y = (alpha^(1/4) - r0) / (1 - r0),  r0 = kMinAlpha^(1/4),
//   slice   z = log(1 + w / s) / log(1 + w1 / s),  w = 1 - min(eta, 1 / eta),  w1 = w of kGlassMaxIndex,  s = mu alpha / 2,
// all from 0 to 1. x keeps what depends on mu / alpha in a column, z what depends on w / (mu alpha) in a slice: near eta = 1
// light is lost by the small turn of refraction, which raises or lowers a cosine mu by about w alpha.
//   A quad holds the four rows and slices around it (row j, j + 1 of slice k, then of k + 1): a look-up is two loads.
// Then, per side and likewise packed, log2 of the means 2 int L mu dmu of what those look-ups give, with s = alpha / 8, and
// last the same of a sheet, whose E is A + B of the reflectance table, in .xy (row j, j + 1).
#ifndef IRRADIA_SHARED_GLASS_TABLE_H
#define IRRADIA_SHARED_GLASS_TABLE_H
#include "shared/scene.h"
SHARED_BEGIN
#ifdef __cplusplus
using glm::log2;
using glm::min;
using glm::sqrt;
#endif

SHARED_CONST uint kGlassCosines = 32u;
SHARED_CONST uint kGlassAlphas = 24u;
SHARED_CONST uint kGlassIndices = 20u;
SHARED_CONST float kGlassMaxIndex = 2.6f;
SHARED_CONST uint kGlassMeanAlphas = kTableRoughnesses; // their rows are those of the reflectance table
SHARED_CONST uint kGlassMeanIndices = 40u;

SHARED_CONST uint kGlassSideQuads = kGlassCosines * (kGlassAlphas - 1u) * (kGlassIndices - 1u);
SHARED_CONST uint kGlassMeanSideQuads = (kGlassMeanAlphas - 1u) * (kGlassMeanIndices - 1u);
SHARED_CONST uint kGlassFirstMean = 2u * kGlassSideQuads;
SHARED_CONST uint kGlassFirstSheet = kGlassFirstMean + 2u * kGlassMeanSideQuads;
SHARED_CONST uint kGlassTableQuads = kGlassFirstSheet + kGlassMeanAlphas - 1u;

// x, y and z. mu > 0 and alpha in [kMinAlpha, 1].
SHARED_INLINE float glassColumn(float mu, float alpha) {
    return 0.5f * (sqrt(mu) + sqrt(mu * (1.0f + 4.0f * alpha) / (mu + 4.0f * alpha)));
}
SHARED_INLINE float glassRow(float alpha) {
    return (sqrt(sqrt(alpha)) - kTableFirstRoot) / (1.0f - kTableFirstRoot);
}
SHARED_INLINE float glassSliceScale(float mu, float alpha) { return 0.5f * mu * alpha; }
SHARED_INLINE float glassMeanSliceScale(float alpha) { return 0.125f * alpha; }
SHARED_INLINE float glassSlice(float eta, float scale) {
    float last = 1.0f - 1.0f / kGlassMaxIndex;
    float w = min(1.0f - min(eta, 1.0f / eta), last);
    return log2(1.0f + w / scale) / log2(1.0f + last / scale);
}

// The quad that holds what follows a node.
SHARED_INLINE uint glassQuad(uint side, uint column, uint row, uint slice) {
    return side * kGlassSideQuads + (slice * (kGlassAlphas - 1u) + row) * kGlassCosines + column;
}
SHARED_INLINE uint glassMeanQuad(uint side, uint row, uint slice) {
    return kGlassFirstMean + side * kGlassMeanSideQuads + slice * (kGlassMeanAlphas - 1u) + row;
}

SHARED_END
#endif
