// What is left of the light from the end of a path's ray (shared/queue.h). Binding: `passages` (quads).
#ifndef IRRADIA_PATH_PASSAGE_GLSL
#define IRRADIA_PATH_PASSAGE_GLSL
#include "path/needs.glsl"

vec3 passageOf(uint path) {
    if (!kHasTransparency) return vec3(1.0);
    return uintBitsToFloat(loadQuad(passages, path).rgb);
}

#endif
