// Who is lit, and by which of the local lights.
#ifndef IRRADIA_PATH_LIGHT_CHOICE_GLSL
#define IRRADIA_PATH_LIGHT_CHOICE_GLSL
#include "lib/math.glsl"
#include "path/needs.glsl"

struct Receiver {
    vec3 point;
    vec3 normal; // unit: light comes from its side alone; 0 = from either side
};

const uint kEitherSide = 0x80008000u; // code of a normal of glass; no unit vector has it

Receiver receiverOf(vec3 point, uint normalCode) {
    bool isEither = kHasGlass && normalCode == kEitherSide;
    return Receiver(point, isEither ? vec3(0.0) : decodeOctahedral(normalCode));
}

struct LightChoice {
    uint light;
    float chance; // 0 = none of the lights reaches the receiver
};

#endif
