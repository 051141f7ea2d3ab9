// What a surface is made of at a point: its material's factors, textures and vertex colours together. Bindings as scene.glsl.
#ifndef IRRADIA_PATH_MATERIAL_GLSL
#define IRRADIA_PATH_MATERIAL_GLSL
#include "path/scene.glsl"

struct MaterialPoint {
    vec3 base;
    float metallic;
    float roughness; // perceptual
    vec3 f0;         // of the dielectric in air, before clamping
    float specular;
    float transmission;
};

MaterialPoint loadMaterial(uint material, TriangleAttributes a) {
    uint at = material * kMaterialQuads;
    vec4 m0 = uintBitsToFloat(loadQuad(materials, at));
    vec4 m2 = uintBitsToFloat(loadQuad(materials, at + 2u));
    MaterialPoint m = MaterialPoint(m0.rgb, m0.w, uintBitsToFloat(loadQuad(materials, at + 1u).w), m2.rgb, m2.w, 0.0);
    if (kHasTransparency) m.transmission = uintBitsToFloat(loadQuad(materials, at + 6u).w);
    if (kTextureMask != 0u) {
        uvec4 codes = loadQuad(materials, at + 4u);
        uvec4 codes2 = loadQuad(materials, at + 5u);
        if ((kTextureMask & kVertexColors) != 0u) m.base = min(m.base * a.color.rgb, vec3(1.0)); // no colour makes light
        if ((kTextureMask & kBaseColorTexture) != 0u) m.base *= sampleTexture(codes.x, a).rgb;
        if ((kTextureMask & kMetallicRoughnessTexture) != 0u) {
            vec4 texel = sampleTexture(codes.y, a);
            m.roughness *= texel.g;
            m.metallic *= texel.b;
        }
        if ((kTextureMask & kSpecularTexture) != 0u) m.specular *= sampleTexture(codes2.x, a).a;
        if ((kTextureMask & kSpecularColorTexture) != 0u) m.f0 *= sampleTexture(codes2.y, a).rgb;
        if (kHasTransparency && (kTextureMask & kTransmissionTexture) != 0u) m.transmission *= sampleTexture(codes2.z, a).r;
    }
    m.roughness = clamp(m.roughness, 0.0, 1.0);
    m.metallic = clamp(m.metallic, 0.0, 1.0);
    return m;
}

#endif
