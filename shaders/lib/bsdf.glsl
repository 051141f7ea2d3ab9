// The surface's BSDF: glTF 2.0 Appendix B (metallic-roughness, KHR_materials_specular and _ior), a Lambert lobe under
// a GGX lobe, with one mend of its energy. Directions are local to the shading normal (+z); v and l point away.
//
//   f = (1 - m) [ base / pi (1 - max Fd(v.h)) min(s(v), s(l)) + Fd spec ] + m Fm spec
//   Fd = w (f0 + (1 - f0) Fc),  Fm = base + (1 - base) Fc,  Fc = (1 - |v.h|)^5,  spec = D G2 / (4 v.z l.z)
//   s(x) = min(1, (1 - E_spec(x)) / E_diffuse(x)): no direction reflects more than it receives.
//
// D is GGX (Walter et al. 2007), G2 height-correlated Smith (Heitz 2014), alpha = roughness^2 >= kMinAlpha.
#ifndef IRRADIA_BSDF_GLSL
#define IRRADIA_BSDF_GLSL
#include "lib/math.glsl"
#include "lib/sampling.glsl"
#include "shared/scene.h"

struct Bsdf {
    vec3 diffuse;      // albedo of the Lambert lobe, (1 - m) base
    vec3 specularF0;   // Fresnel of the GGX lobe at normal incidence, both materials mixed
    float specularF90; // and at grazing incidence
    float layerF0;     // max Fd at normal incidence: what the Lambert lobe loses to the dielectric layer above it
    float layerF90;
    float alpha;
};

// f0 is the dielectric's reflectance at normal incidence before clamping, w its specular factor.
Bsdf makeBsdf(vec3 base, float metallic, float roughness, vec3 f0, float w) {
    f0 = min(f0, vec3(1.0));
    return Bsdf((1.0 - metallic) * base, (1.0 - metallic) * w * f0 + metallic * base,
                (1.0 - metallic) * w + metallic, w * maxComponent(f0), w,
                max(roughness * roughness, kMinAlpha));
}

// What a direction reflects through each lobe, from the reflectance table's (A, B, C) at its cosine.
vec3 specularReflectance(Bsdf b, vec3 abc) { return b.specularF0 * abc.x + b.specularF90 * abc.y; }
float diffuseReflectance(Bsdf b, vec3 abc) { return 1.0 - mix(b.layerF0, b.layerF90, abc.z); }

// The mend s(x).
float diffuseMend(Bsdf b, vec3 abc) {
    float specular = b.layerF0 * abc.x + b.layerF90 * abc.y;
    float diffuse = diffuseReflectance(b, abc);
    return diffuse > 1e-6 ? clamp((1.0 - specular) / diffuse, 0.0, 1.0) : 0.0;
}

// Probability of sampling the GGX lobe: its share of the reflectance of the view direction. abc and mend are v's.
float specularProbability(Bsdf b, vec3 abc, float mend) {
    float specular = luminance(specularReflectance(b, abc));
    float diffuse = luminance(b.diffuse) * diffuseReflectance(b, abc) * mend;
    return specular + diffuse > 0.0 ? specular / (specular + diffuse) : 0.0;
}

// GGX over h, stable for small alpha because it uses h's own tangential part.
float ggxDistribution(vec3 h, float alpha) {
    float d = dot(h.xy, h.xy) / (alpha * alpha) + h.z * h.z;
    return kInvPi / max(square(alpha * d), 1e-30);
}

// sqrt(alpha^2 + (1 - alpha^2) c^2), the root in Smith's G1 = 2 c / (c + root).
float smithRoot(float c, float alpha) { return sqrt(mix(c * c, 1.0, alpha * alpha)); }

// f(v, l) |l.z| and the density of sampling l from v, of both lobes together. v.z > 0 and l.z > 0.
struct BsdfValue {
    vec3 fCos;
    float pdf;
};

BsdfValue evaluateBsdf(Bsdf b, vec3 v, vec3 l, float mend, float pSpecular, bool hasSpecular) {
    if (!hasSpecular) return BsdfValue(b.diffuse * (l.z * kInvPi), l.z * kInvPi);
    vec3 h = normalize(v + l);
    float fc = schlickWeight(dot(v, h));
    float d = ggxDistribution(h, b.alpha);
    float rootV = smithRoot(v.z, b.alpha);
    float rootL = smithRoot(l.z, b.alpha);
    float specular = d * 0.5 / max(l.z * rootV + v.z * rootL, 1e-20);
    vec3 fresnel = mix(b.specularF0, vec3(b.specularF90), fc);
    float layer = mix(b.layerF0, b.layerF90, fc);
    vec3 f = b.diffuse * (kInvPi * (1.0 - layer) * mend) + fresnel * specular;
    float pdfSpecular = d * 0.5 / (v.z + rootV);
    return BsdfValue(f * l.z, mix(l.z * kInvPi, pdfSpecular, pSpecular));
}

// A direction from v: u.x chooses the lobe, u.yz the direction in it. l.z <= 0 is possible and means nothing is reflected.
vec3 sampleBsdf(Bsdf b, vec3 v, vec3 u, float pSpecular, bool hasSpecular) {
    vec3 diffuse = sampleCosineHemisphere(u.yz);
    if (!hasSpecular) return diffuse;
    vec3 h = sampleVisibleNormal(v, b.alpha, u.yz);
    vec3 specular = 2.0 * dot(v, h) * h - v;
    return u.x < pSpecular ? specular : diffuse;
}

#endif
