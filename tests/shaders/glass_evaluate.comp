#version 460
#extension GL_GOOGLE_include_directive : require
// Item i: f cos and density of direction i under case i; what weighs its lobes; f cos for punctual lights.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, cases);
QUADS_READ(1, reflectanceTable);
QUADS_READ(2, glassTable);
QUADS_READ(3, directions);
QUADS_WRITE(4, results); // 4 each, as GlassEvaluation has them
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "glass_case.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    GlassCase c = loadCase(i);
    vec3 l = uintBitsToFloat(loadQuad(directions, i).xyz);
    BsdfValue value = evaluateCase(c, l);
    vec2 t = towards(c, l);
    vec3 punctual = evaluateGlass(c.bsdf, c.glass, c.view, c.v, l, t.x, t.y, true).fCos;
    storeQuad(results, 4u * i, floatBitsToUint(vec4(value.fCos, value.pdf)));
    storeQuad(results, 4u * i + 1u, floatBitsToUint(vec4(t, c.view.pDiffuse, c.view.pFacets)));
    storeQuad(results, 4u * i + 2u, floatBitsToUint(vec4(c.view.pReturn, c.view.multiple, c.glass.eta, c.view.transmits)));
    storeQuad(results, 4u * i + 3u, floatBitsToUint(vec4(punctual, c.view.pMultiple)));
}
