// The size of workgroup and subgroup, what constant 1 says of the latter, and the subgroups of a workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

WORDS_WRITE(0, sizes);

void main() {
    if (gl_GlobalInvocationID.x != 0) return;
    storeWord(sizes, 0, gl_WorkGroupSize.x);
    storeWord(sizes, 1, gl_SubgroupSize);
    storeWord(sizes, 2, kSubgroupSize);
    storeWord(sizes, 3, gl_NumSubgroups);
}
