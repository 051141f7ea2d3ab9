// Light arrives whole or not at all.
WORDS_READ(1, visibility);

vec3 arrivingShare(uint slot) { return vec3(loadWord(visibility, slot)); }
