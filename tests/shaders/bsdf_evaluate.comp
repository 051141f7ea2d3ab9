#version 460
#extension GL_GOOGLE_include_directive : require
// Item i: f cos and density of direction i under case i; its mend and the GGX lobe's probability.
#include "lib/kernel.glsl"
#include "harness.h"

QUADS_READ(0, cases);
QUADS_READ(1, reflectanceTable);
QUADS_READ(2, directions);
QUADS_WRITE(3, results); // 2 each: f cos rgb, density; mend, probability of the GGX lobe
layout(push_constant) uniform Push { BsdfHarnessParams params; };
#include "bsdf_case.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    BsdfCase c = loadCase(i);
    vec3 l = uintBitsToFloat(loadQuad(directions, i).xyz);
    BsdfValue value = evaluateCase(c, l);
    storeQuad(results, 2u * i, floatBitsToUint(vec4(value.fCos, value.pdf)));
    storeQuad(results, 2u * i + 1u, floatBitsToUint(vec4(mendTowards(c, l), c.pSpecular, 0.0, 0.0)));
}
