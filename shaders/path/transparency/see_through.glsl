// What surfaces let straight on through: where they are not (glTF's alpha), and what a clear sheet transmits (smooth
// KHR_materials_transmission without a volume). Bindings as scene.glsl.
#ifndef IRRADIA_PATH_SEE_THROUGH_GLSL
#define IRRADIA_PATH_SEE_THROUGH_GLSL
#include "path/coverage.glsl"
#include "path/material.glsl"

// Of sheets; what is rougher scatters the light it transmits.
bool isClear(float roughness) { return square(roughness) <= kMinAlpha; }

// The vertices' normal: what a normal map does to the light that goes straight on is nothing.
vec3 smoothNormal(uint primitive, vec2 b) {
    uvec3 codes = loadQuad(geometry, primitive * kGeometryQuads + 3u).xyz;
    vec3 n = (1.0 - b.x - b.y) * decodeOctahedral(codes.x) + b.x * decodeOctahedral(codes.y) + b.y * decodeOctahedral(codes.z);
    return n * inversesqrt(max(dot(n, n), 1e-20));
}

// Of what is there of a sheet: its colour less what it reflects, where it is clear.
vec3 sheetTransmittance(uint material, TriangleAttributes a, float cosine) {
    MaterialPoint m = loadMaterial(material, a);
    float f0 = min(maxComponent(m.f0), 1.0);
    float reflected = m.specular * mix(f0, 1.0, schlickWeight(cosine));
    vec3 transmitted = m.base * ((1.0 - m.metallic) * m.transmission * (1.0 - reflected));
    return isClear(m.roughness) ? transmitted : vec3(0.0);
}

struct SeeThrough {
    vec3 passing;
    float coverage; // what scatters, reflects and emits is weighted by this
};

SeeThrough seeThrough(uint primitive, vec2 b, vec3 direction) {
    uint material = loadQuad(geometry, primitive * kGeometryQuads).w;
    TriangleAttributes a = attributesFor(kAllAttributes, primitive, b);
    float coverage = coverageOf(material, a);
    vec3 passing = vec3(1.0 - coverage);
    uint flags = loadQuad(materials, material * kMaterialQuads + 3u).y;
    if ((flags & kMaterialSheet) != 0u)
        passing += coverage * sheetTransmittance(material, a, abs(dot(smoothNormal(primitive, b), direction)));
    return SeeThrough(passing, coverage);
}

#endif
