// What a vertex scatters: the BSDF of surfaces that light does not enter or, in scenes that have glass, its lobes on both
// sides. Directions l are local. Bindings: `reflectanceTable` and `glassTable` (quads).
#ifndef IRRADIA_PATH_SCATTERING_GLSL
#define IRRADIA_PATH_SCATTERING_GLSL
#include "path/glass_table.glsl"
#include "path/lights/punctual.glsl"
#include "path/reflectance.glsl"
#include "path/surface.glsl"

// All that depends on the view direction alone.
struct Scattering {
    vec3 view; // local
    float mend;
    float pSpecular;
    GlassView glass;
};

Scattering prepareScattering(Surface s, vec3 view) {
    Scattering x;
    x.view = view;
    if (kHasGlass) {
        vec3 abc = reflectanceAt(thinCosine(s.glass, view.z), s.roughness);
        x.mend = glassMend(s.bsdf, s.glass, view.z, abc);
        x.glass = prepareGlass(s.bsdf, s.glass, view, abc, x.mend, glassLossesOf(s.glass, s.bsdf.alpha, view, abc));
    } else {
        vec3 abc = reflectanceAt(view.z, s.roughness);
        x.mend = diffuseMend(s.bsdf, abc);
        x.pSpecular = kHasSpecular ? specularProbability(s.bsdf, abc, x.mend) : 0.0;
    }
    return x;
}

BsdfValue evaluateScattering(Surface s, Scattering x, vec3 l, bool isPunctual) {
    if (kHasGlass) {
        vec3 abc = reflectanceAt(thinCosine(s.glass, abs(l.z)), s.roughness);
        float mend = min(x.mend, glassMend(s.bsdf, s.glass, abs(l.z), abc));
        float loss = glassLossTowards(s.glass, s.bsdf.alpha, l, abc);
        BsdfValue value = evaluateGlass(s.bsdf, s.glass, x.glass, x.view, l, mend, loss, isPunctual);
        // Radiance is carried divided by the squared index of where it is: then no face makes light of a wrong one.
        if (l.z < 0.0) value.fCos *= square(s.glass.eta);
        return value;
    }
    float mend = min(x.mend, diffuseMend(s.bsdf, reflectanceAt(l.z, s.roughness)));
    Bsdf lit = s.bsdf;
    if (isPunctual) lit = bsdfUnderPunctual(lit);
    return evaluateBsdf(lit, x.view, l, mend, x.pSpecular, kHasSpecular);
}

vec3 sampleScattering(Surface s, Scattering x, vec3 u) {
    if (kHasGlass) return sampleGlass(s.bsdf, s.glass, x.glass, x.view, u);
    return sampleBsdf(s.bsdf, x.view, u, x.pSpecular, kHasSpecular);
}

// Whether light goes that way: on one side of the face and of the shading normal.
bool isScattered(Surface s, vec3 l, vec3 direction) {
    float side = dot(s.geometricNormal, direction);
    return (l.z > 0.0 && side > 0.0) || (kHasGlass && s.isGlass && l.z < 0.0 && side < 0.0);
}

// Where rays start, and in which media, on the side of l.
vec3 leavingPoint(Surface s, vec3 l) {
    bool isBeyond = kHasGlass && l.z < 0.0;
    return s.position + (isBeyond ? -s.geometricNormal : s.geometricNormal) * s.error;
}

uint leavingMedia(Surface s, vec3 l) { return l.z < 0.0 ? s.mediaBeyond : s.mediaHere; }

// How the vertex' rays know it again as a receiver of light.
uint receiverCode(Surface s) { return kHasGlass && s.isGlass ? kEitherSide : encodeOctahedral(s.shadingNormal); }

#endif
