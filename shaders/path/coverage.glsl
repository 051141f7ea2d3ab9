// How much of a surface is there: glTF's alpha. Bindings as scene.glsl.
#ifndef IRRADIA_PATH_COVERAGE_GLSL
#define IRRADIA_PATH_COVERAGE_GLSL
#include "path/scene.glsl"

float coverageOf(uint material, TriangleAttributes a) {
    uint at = material * kMaterialQuads;
    uvec4 values = loadQuad(materials, at + 3u);
    float alpha = uintBitsToFloat(values.z);
    if ((kTextureMask & kBaseColorTexture) != 0u) alpha *= sampleTexture(loadQuad(materials, at + 4u).x, a).a;
    alpha = clamp(alpha * a.color.a, 0.0, 1.0);
    float masked = alpha >= uintBitsToFloat(values.w) ? 1.0 : 0.0;
    return (values.y & kMaterialMask) != 0u ? masked : ((values.y & kMaterialBlend) != 0u ? alpha : 1.0);
}

#endif
