// The shaded point of a hit: its frame, its BSDF and what it parts, textures applied. Bindings as scene.glsl.
#ifndef IRRADIA_PATH_SURFACE_GLSL
#define IRRADIA_PATH_SURFACE_GLSL
#include "lib/glass.glsl"
#include "lib/plane_error.glsl"
#include "path/material.glsl"
#include "path/media.glsl"
#include "path/scene.glsl"

struct Surface {
    vec3 position;
    float error; // rays leave the position along the normal by this length, so that they do not hit their own surface
    vec3 geometricNormal; // on the side of the viewer
    vec3 shadingNormal;   // likewise, and never facing away from the viewer
    Bsdf bsdf;
    float roughness;
    bool isGlass; // it has lobes beyond itself: glass says which
    Glass glass;
    uint mediaHere; // of rays that leave on the viewer's side,
    uint mediaBeyond; // and on the other
};

const float kMinShadingCosine = 0.01; // of the viewer: interpolated and mapped normals are bent to it

vec3 perturbNormal(vec3 ns, vec3 texel, float scale, TriangleAttributes a, uint handedness, vec2 b) {
    float b0 = 1.0 - b.x - b.y;
    vec3 t = b0 * decodeOctahedral(a.tangents.x) + b.x * decodeOctahedral(a.tangents.y) +
             b.y * decodeOctahedral(a.tangents.z);
    t -= ns * dot(ns, t);
    float length2 = dot(t, t);
    vec3 tangent = t * inversesqrt(max(length2, 1e-20));
    vec3 bitangent = cross(ns, tangent) * ((handedness & 1u) != 0u ? -1.0 : 1.0);
    vec3 m = texel * 2.0 - 1.0;
    vec3 n = normalize(m.x * scale * tangent + m.y * scale * bitangent + m.z * ns);
    bool usable = a.tangents.x != kNoTangent && length2 > 1e-12 && dot(n, n) > 0.5;
    return usable ? n : ns;
}

// `media`: those from which it is seen.
Surface loadSurface(uint primitive, vec2 b, vec3 view, uint media) {
    TriangleGeometry tri = loadTriangle(primitive);
    uvec3 normals = loadQuad(geometry, primitive * kGeometryQuads + 3u).xyz;
    TriangleAttributes a = attributesFor(kAllAttributes, primitive, b);

    MaterialPoint m = loadMaterial(tri.material, a);
    float b0 = 1.0 - b.x - b.y;
    vec3 ng = cross(tri.e1, tri.e2);
    float doubleArea = length(ng);
    ng /= doubleArea;
    vec3 ns = b0 * decodeOctahedral(normals.x) + b.x * decodeOctahedral(normals.y) + b.y * decodeOctahedral(normals.z);
    ns = dot(ns, ns) > 1e-8 ? normalize(ns) : ng;
    if ((kTextureMask & kNormalTexture) != 0u) {
        uint at = tri.material * kMaterialQuads;
        uint code = loadQuad(materials, at + 4u).z;
        float scale = uintBitsToFloat(loadQuad(materials, at + 3u).x);
        vec3 bent = perturbNormal(ns, sampleTexture(code, a).xyz, scale, a, tri.handedness, b);
        ns = code == kNoTexture ? ns : bent;
    }

    bool front = dot(ng, view) > 0.0;
    ng = front ? ng : -ng;
    ns = front ? ns : -ns;
    float cosine = dot(ns, view);
    ns = cosine < kMinShadingCosine ? normalize(ns + (kMinShadingCosine - cosine) * view) : ns;

    Surface s;
    s.position = tri.p0 + b.x * tri.e1 + b.y * tri.e2;
    vec3 reach = abs(b.x * tri.e1) + abs(b.y * tri.e2);
    s.error = pointError(ng, tri.p0, reach, s.position) + heightError(tri.e1, tri.e2, doubleArea, reach);
    s.geometricNormal = ng;
    s.shadingNormal = ns;
    s.roughness = m.roughness;
    s.isGlass = false;
    if (kHasGlass) {
        Interface face = interfaceOf(media, tri.material, front);
        if (face.isSolid) m.f0 *= pairReflectance(face.index, face.eta);
        s.glass = makeGlass(m.base, m.metallic, m.transmission, m.f0, m.specular, face.eta, !face.isSolid);
        s.isGlass = m.transmission > 0.0 && (face.isSolid || square(m.roughness) > kMinAlpha);
        s.mediaHere = face.here;
        s.mediaBeyond = face.beyond;
    }
    s.bsdf = makeBsdf(m.base, m.metallic, m.roughness, m.f0, m.specular);
    if (kHasTransparency) s.bsdf.diffuse *= 1.0 - m.transmission;
    return s;
}

#endif
