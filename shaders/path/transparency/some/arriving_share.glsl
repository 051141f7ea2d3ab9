// What is left of the light that surfaces on its way let through.
QUADS_READ(1, visibility);

vec3 arrivingShare(uint slot) { return uintBitsToFloat(loadQuad(visibility, slot).rgb); }
