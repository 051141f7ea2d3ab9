// Access to the scene's quads (shared/scene.h). The kernel includes this after declaring the bindings it needs:
// `geometry`, `attributes`, `materials`, `textures` (quads) and `texels` (halves).
#ifndef IRRADIA_PATH_SCENE_GLSL
#define IRRADIA_PATH_SCENE_GLSL
#include "lib/math.glsl"
#include "path/needs.glsl"
#include "shared/scene.h"

// The triangle's plane and what it is made of.
struct TriangleGeometry {
    vec3 p0;
    vec3 e1;
    vec3 e2;
    uint material;
    uint light;
    uint handedness;
};

TriangleGeometry loadTriangle(uint primitive) {
    uint at = primitive * kGeometryQuads;
    uvec4 r0 = loadQuad(geometry, at);
    uvec4 r1 = loadQuad(geometry, at + 1u);
    uvec4 r2 = loadQuad(geometry, at + 2u);
    return TriangleGeometry(uintBitsToFloat(r0.xyz), uintBitsToFloat(r1.xyz), uintBitsToFloat(r2.xyz), r0.w, r1.w, r2.w);
}

// Texture coordinates of both sets at barycentrics (u, v), the tangents' codes, and the vertices' colour.
struct TriangleAttributes {
    vec2 uv[2];
    uvec3 tangents;
    vec4 color;
};

const uint kAttributeStride = (kTextureMask & kVertexColors) != 0u ? kColouredAttributeQuads : kAttributeQuads;

vec4 colorOf(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }

TriangleAttributes loadAttributes(uint primitive, vec2 b) {
    uint at = primitive * kAttributeStride;
    vec4 a0 = uintBitsToFloat(loadQuad(attributes, at));
    vec4 a1 = uintBitsToFloat(loadQuad(attributes, at + 1u));
    vec4 a2 = uintBitsToFloat(loadQuad(attributes, at + 2u));
    uvec4 a3 = loadQuad(attributes, at + 3u);
    float b0 = 1.0 - b.x - b.y;
    TriangleAttributes result;
    result.uv[0] = b0 * a0.xy + b.x * a0.zw + b.y * a1.xy;
    result.uv[1] = b0 * a1.zw + b.x * a2.xy + b.y * a2.zw;
    result.tangents = a3.xyz;
    result.color = vec4(1.0);
    if ((kTextureMask & kVertexColors) != 0u) {
        uvec4 c01 = loadQuad(attributes, at + 4u);
        vec4 first = colorOf(c01.xy); // exact where all three are equal: a mask's cutoff may be
        vec4 third = colorOf(loadQuad(attributes, at + 5u).xy);
        result.color = first + b.x * (colorOf(c01.zw) - first) + b.y * (third - first);
    }
    return result;
}

TriangleAttributes attributesFor(uint mask, uint primitive, vec2 b) {
    if ((kTextureMask & mask) != 0u) return loadAttributes(primitive, b);
    return TriangleAttributes(vec2[2](vec2(0.0), vec2(0.0)), uvec3(kNoTangent), vec4(1.0));
}

// From 0 to n - 1. The quotient may be one off, and is on GPUs, whose division need not be exact for multiples of n.
int positiveRemainder(int i, int n) {
    int r = i - n * int(floor(float(i) / float(n)));
    return r < 0 ? r + n : (r >= n ? r - n : r);
}

int wrapTexel(int i, int size, uint mode) {
    int repeated = positiveRemainder(i, size);
    int folded = positiveRemainder(i, 2 * size);
    int mirrored = min(folded, 2 * size - 1 - folded);
    int clamped = clamp(i, 0, size - 1);
    return mode == 0u ? repeated : (mode == 1u ? mirrored : clamped);
}

// KHR_texture_transform.
vec2 transformed(vec2 uv, uint transform) {
    vec4 columns = uintBitsToFloat(loadQuad(textures, transform));
    vec2 offset = uintBitsToFloat(loadQuad(textures, transform + 1u).xy);
    return transform == 0u ? uv : uv.x * columns.xy + uv.y * columns.zw + offset;
}

// Bilinear at texel centres; (1, 1, 1, 1) for kNoTexture.
vec4 sampleTexture(uint code, TriangleAttributes a) {
    bool none = code == kNoTexture;
    uvec4 texture = loadQuad(textures, none ? 0u : code >> 1u);
    ivec2 size = max(ivec2(texture.yz), ivec2(1));
    vec2 uv = (code & 1u) == 0u ? a.uv[0] : a.uv[1];
    if ((kTextureMask & kTextureTransforms) != 0u) uv = transformed(uv, texture.w >> 4u);
    // A non-finite or absurd coordinate must not become an undefined integer.
    vec2 x = clamp(uv * vec2(size) - 0.5, vec2(-1e6), vec2(1e6));
    vec2 corner = floor(x);
    vec2 f = x - corner;
    ivec2 i = ivec2(corner);
    uint wrapS = texture.w & 3u;
    uint wrapT = (texture.w >> 2u) & 3u;
    int x0 = wrapTexel(i.x, size.x, wrapS);
    int x1 = wrapTexel(i.x + 1, size.x, wrapS);
    int y0 = wrapTexel(i.y, size.y, wrapT) * size.x + int(texture.x);
    int y1 = wrapTexel(i.y + 1, size.y, wrapT) * size.x + int(texture.x);
    vec4 top = mix(loadHalves(texels, y0 + x0), loadHalves(texels, y0 + x1), f.x);
    vec4 bottom = mix(loadHalves(texels, y1 + x0), loadHalves(texels, y1 + x1), f.x);
    return none ? vec4(1.0) : mix(top, bottom, f.y);
}

// Which attributes emittedRadiance takes, and the coverage beside it.
const uint kEmissionAttributes = kEmissiveTexture | kVertexColors | (kHasTransparency ? kBaseColorTexture : 0u);

// Radiance that a triangle's front (or a double-sided one's either side) emits at texture coordinates `a`.
vec3 emittedRadiance(uint material, bool front, TriangleAttributes a) {
    uint at = material * kMaterialQuads;
    vec3 emission = uintBitsToFloat(loadQuad(materials, at + 1u).xyz);
    uint flags = loadQuad(materials, at + 3u).y;
    if ((kTextureMask & kEmissiveTexture) != 0u) emission *= sampleTexture(loadQuad(materials, at + 4u).w, a).rgb;
    if ((kTextureMask & kVertexColors) != 0u && (flags & kMaterialUnlit) != 0u) emission *= a.color.rgb;
    return front || (flags & kMaterialDoubleSided) != 0u ? emission : vec3(0.0);
}

#endif
