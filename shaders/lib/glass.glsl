// Glass: what a transmissive surface scatters, over the whole sphere; v.z > 0, l.z < 0 is transmitted. It adds to bsdf.glsl,
// whose `diffuse` then holds the factor 1 - tau (tau = transmission), and whose F0 is of the pair of media:
//   f = (1 - tau) Lambert + F spec                                            l.z > 0
//     + (1 - m) tau [ base (1 - max Fd) transmission + (1 or base) f_ms ]     l.z < 0, f_ms on both sides
// Sheets (isSheet) transmit by the mirror image l' = (l.x, l.y, -l.z): transmission = D G2(v, l') / (4 v.z l'.z).
// Solids refract, with eta = n_l / n_v (Walter et al. 2007, eq. 16, 17 and 21, as radiance):
//   transmission = |v.h| |l.h| D G2 / (v.z |l.z| |v + eta l|^2),  h ~ -(v + eta l), in G2 both sides' Lambda.
// Their Fresnel is Schlick's with the cosine in the thinner medium, 1 beyond the critical angle.
// f_ms = (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg_v + eta^2 (1 - Eavg_l))) returns what single scattering loses (Kulla and Conty
// 2017, "Revisiting Physically Based Shading at Imageworks", of both sides): the E of engine/scene/glass_table.
// Smooth surfaces, alpha <= kMinAlpha, have no f_ms, and smooth sheets no transmission either: rays pass straight through.
#ifndef IRRADIA_GLASS_GLSL
#define IRRADIA_GLASS_GLSL
#include "lib/bsdf.glsl"

struct Glass {
    vec3 tint;           // (1 - m) tau base: of what is transmitted
    float share;         // (1 - m) tau
    vec3 dielectricF0;   // (1 - m) w f0: the dielectric's part of Bsdf::specularF0
    float dielectricF90; // (1 - m) w
    float dielectric;    // 1 - m: what it reflects beyond the critical angle
    float eta;           // index on the far side over that on the viewer's; 1 of sheets
    bool isSheet;
};

// Factor of a dielectric's f0, that of `ior` in air, where it parts media of relative index eta.
float pairReflectance(float ior, float eta) {
    float air = (ior - 1.0) / (ior + 1.0);
    float pair = (eta - 1.0) / (eta + 1.0);
    return air != 0.0 ? square(pair / air) : 1.0;
}

// Solids' eta keeps away from 1, where refraction turns nothing and has no half vector: by an angle of at most 1e-3.
float awayFromOne(float eta) { return eta < 1.0 ? min(eta, 1.0 / 1.001) : max(eta, 1.001); }

// To the Bsdf of the same base, metallic, f0 (of the pair of media) and w; eta is away from 1.
Glass makeGlass(vec3 base, float metallic, float tau, vec3 f0, float w, float eta, bool isSheet) {
    float dielectric = 1.0 - metallic;
    return Glass(dielectric * tau * base, dielectric * tau, dielectric * w * min(f0, vec3(1.0)), dielectric * w, dielectric,
                 isSheet ? 1.0 : eta, isSheet);
}

// 1 - E of the view direction, and what weighs the two sides in the multiple-scattering lobe: 1 - Eavg on the viewer's
// side, eta^2 (1 - Eavg) on the far side.
struct GlassLosses {
    float view;
    float near;
    float far;
};

// What depends on the view direction alone.
struct GlassView {
    float pDiffuse;  // probabilities of sampling the Lambert lobe,
    float pFacets;   // micro-facets, which reflect or transmit,
    float pMultiple; // and multiple scattering (not 1 less the others: that would round 1e-8 to 0),
    float pReturn;   // and of that the share which goes to the viewer's side
    float multiple;  // f_ms / (1 - E(l))
    float transmits; // 1, of smooth sheets 0: factor of transmission
};

// Fresnel of a facet: reflectance of all, and max Fd of the dielectric.
struct GlassFresnel {
    vec3 reflectance;
    float layer;
};

// Square of the cosine behind a facet that is met at cosine c; below 0 beyond the critical angle.
float refractedSquare(float c, float eta) { return 1.0 - max(1.0 - c * c, 0.0) / (eta * eta); }

// Where the reflectance table is read for the Lambert lobe's mend at cosine mu, and that mend: in the thinner medium. A
// surface that reflects all has no diffuse light to give.
float thinCosine(Glass g, float mu) { return g.eta < 1.0 ? sqrt(max(refractedSquare(mu, g.eta), 0.0)) : mu; }
float glassMend(Bsdf b, Glass g, float mu, vec3 abc) { return thinCosine(g, mu) > 0.0 ? diffuseMend(b, abc) : 0.0; }

// Of a facet with cosines c to the viewer and, in the dense medium, `refracted` behind it, 0 = all is reflected.
GlassFresnel glassFresnel(Bsdf b, Glass g, float c, float refracted) {
    float fc = schlickWeight(c);
    float thin = g.eta < 1.0 ? schlickWeight(refracted) : fc;
    bool isTotal = g.eta < 1.0 && refracted <= 0.0;
    vec3 metal = mix(b.specularF0 - g.dielectricF0, vec3(b.specularF90 - g.dielectricF90), fc);
    vec3 dielectric = isTotal ? vec3(g.dielectric) : mix(g.dielectricF0, vec3(g.dielectricF90), thin);
    return GlassFresnel(max(metal, vec3(0.0)) + dielectric, isTotal ? 1.0 : mix(b.layerF0, b.layerF90, thin));
}

// Probability that a sampled facet reflects.
float reflectionProbability(Glass g, GlassView view, GlassFresnel fresnel) {
    float reflected = luminance(fresnel.reflectance);
    float transmitted = luminance(g.tint) * (1.0 - fresnel.layer) * view.transmits;
    return transmitted > 0.0 ? reflected / (reflected + transmitted) : 1.0;
}

// What comes back of a loss that the table has for w = 1 and the indices' F0. E is linear in F, of which this is the part
// that is so; the rest returns nothing, so that no surface scatters more than it receives, but for 1e-4, which F of indices
// next to each other is below. Sheets lose the same by any F.
float returnedShare(Bsdf b, Glass g) {
    float indices = square((g.eta - 1.0) / (g.eta + 1.0));
    float f0 = b.layerF90 > 0.0 ? b.layerF0 / b.layerF90 : 0.0;
    float share = f0 <= indices ? (f0 + 1e-4) / indices : (1.0 - f0 + 1e-4) / (1.0 - indices);
    share = b.layerF90 * min(share, 1.0);
    return g.isSheet ? 1.0 : share;
}

// Lobes are chosen by estimates of their albedo: of facets as if all lay flat, of the rest exact. abc and mend are v's.
GlassView prepareGlass(Bsdf b, Glass g, vec3 v, vec3 abc, float mend, GlassLosses losses) {
    bool isSmooth = b.alpha <= kMinAlpha;
    float loss = isSmooth ? 0.0 : losses.view * returnedShare(b, g);
    float sides = max(losses.near + losses.far, 1e-12);
    GlassView view;
    view.transmits = isSmooth && g.isSheet ? 0.0 : 1.0;
    view.multiple = loss * kInvPi / sides;

    float tint = luminance(g.tint);
    float refracted = sqrt(max(refractedSquare(v.z, g.eta), 0.0));
    GlassFresnel level = glassFresnel(b, g, v.z, refracted);
    // Rough facets reflect totally at cosines at which a flat one does not.
    float total = g.eta < 1.0 ? 0.5 * b.alpha * g.dielectric : 0.0;
    float solid = (max(luminance(level.reflectance), total) + tint * (1.0 - level.layer)) * (1.0 - losses.view);
    float passing = abc.x + abc.y - (b.layerF0 * abc.x + b.layerF90 * abc.y);
    float sheet = luminance(specularReflectance(b, abc)) + tint * max(passing, 0.0) * view.transmits;
    float facets = g.isSheet ? sheet : solid;
    float diffuse = luminance(b.diffuse) * diffuseReflectance(b, abc) * mend;
    float returned = g.share * losses.near;
    float passed = tint * losses.far;
    float multiple = loss * (returned + passed) / sides;
    float sum = diffuse + facets + multiple;
    view.pDiffuse = sum > 0.0 ? diffuse / sum : 1.0;
    view.pFacets = sum > 0.0 ? facets / sum : 0.0;
    view.pMultiple = sum > 0.0 ? multiple / sum : 0.0;
    view.pReturn = returned + passed > 0.0 ? returned / (returned + passed) : 1.0;
    return view;
}

// Cosines of the multiple-scattering lobe: density mu / (pi (mu^2 + a^2) log(1 + 1 / a^2)), a = 2 alpha, over a
// hemisphere, about as (1 - E(mu)) mu is: of rough glass by cosine, of smoother glass rather grazing.
const float kMultipleSpread = 2.0;

float multipleDensity(float mu, float alpha) {
    float a2 = square(kMultipleSpread * alpha);
    return mu * kInvPi / ((mu * mu + a2) * log(1.0 + 1.0 / a2));
}

vec3 sampleMultiple(float alpha, vec2 u) {
    float a2 = square(kMultipleSpread * alpha);
    float mu2 = clamp(a2 * (exp(u.x * log(1.0 + 1.0 / a2)) - 1.0), 0.0, 1.0);
    float r = sqrt(1.0 - mu2);
    float phi = 2.0 * kPi * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(mu2));
}

// f(v, l) |l.z| and the density of sampleGlass, over solid angle. mend is the smaller of v's and l's, loss 1 - E(l) on l's
// side. Under a light without extent (isPunctual) smooth facets show nothing of it.
BsdfValue evaluateGlass(Bsdf b, Glass g, GlassView view, vec3 v, vec3 l, float mend, float loss, bool isPunctual) {
    float lz = abs(l.z);
    bool returns = l.z > 0.0;
    bool refracts = l.z < 0.0 && !g.isSheet;
    vec3 sum = refracts ? (g.eta < 1.0 ? v + g.eta * l : -v - g.eta * l) : v + vec3(l.xy, lz);
    float length2 = max(dot(sum, sum), 1e-20);
    vec3 h = sum / sqrt(length2);
    float vh = dot(v, h);
    float lh = refracts ? -dot(l, h) : vh;
    bool exists = lz > 0.0 && h.z > 0.0 && vh > 0.0 && lh > 0.0;

    float behind = refracts ? lh : sqrt(max(refractedSquare(vh, g.eta), 0.0));
    GlassFresnel fresnel = glassFresnel(b, g, vh, behind);
    float pReflect = reflectionProbability(g, view, fresnel);
    vec3 color = returns ? fresnel.reflectance : g.tint * ((1.0 - fresnel.layer) * view.transmits);
    float jacobian = refracts ? 4.0 * vh * lh / length2 : 1.0; // beside that of a reflection
    float d = ggxDistribution(h, b.alpha) * jacobian * 0.5;
    float rootV = smithRoot(v.z, b.alpha);
    float masked = d / max(lz * rootV + v.z * smithRoot(lz, b.alpha), 1e-20);
    float visible = d * (refracts ? square(g.eta) : 1.0) / (v.z + rootV);

    float layer = returns ? kInvPi * (1.0 - fresnel.layer) * mend : 0.0;
    vec3 f = b.diffuse * layer + (returns ? vec3(g.share) : g.tint) * (view.multiple * loss);
    f += exists && !(isPunctual && b.alpha <= kMinAlpha) ? color * masked : vec3(0.0);
    float pdf = returns ? view.pDiffuse * lz * kInvPi : 0.0;
    pdf += view.pMultiple * (returns ? view.pReturn : 1.0 - view.pReturn) * multipleDensity(lz, b.alpha);
    pdf += exists ? view.pFacets * (returns ? pReflect : 1.0 - pReflect) * visible : 0.0;
    return BsdfValue(f * lz, pdf);
}

// A direction from v: u.x chooses the lobe and then the side, u.yz the direction in it. 0 where a facet sends it to the
// wrong side: nothing is scattered.
vec3 sampleGlass(Bsdf b, Glass g, GlassView view, vec3 v, vec3 u) {
    vec3 diffuse = sampleCosineHemisphere(u.yz);
    vec3 h = sampleVisibleNormal(v, b.alpha, u.yz);
    float c = clamp(dot(v, h), 0.0, 1.0);
    float refracted = sqrt(max(refractedSquare(c, g.eta), 0.0));
    bool reflects = (u.x - view.pDiffuse) < view.pFacets * reflectionProbability(g, view, glassFresnel(b, g, c, refracted));
    vec3 mirrored = 2.0 * c * h - v;
    vec3 passed = g.isSheet ? vec3(mirrored.xy, -mirrored.z) : normalize((c / g.eta - refracted) * h - v / g.eta);
    vec3 facet = reflects ? mirrored : passed;
    facet = facet.z > 0.0 == reflects ? facet : vec3(0.0);

    vec3 multiple = sampleMultiple(b.alpha, u.yz);
    float first = view.pDiffuse + view.pFacets;
    multiple.z *= u.x - first < view.pMultiple * view.pReturn ? 1.0 : -1.0;
    return u.x < view.pDiffuse ? diffuse : (u.x < first ? facet : multiple);
}

#endif
