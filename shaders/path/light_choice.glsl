// Who is lit, and by which of the local lights.
#ifndef IRRADIA_PATH_LIGHT_CHOICE_GLSL
#define IRRADIA_PATH_LIGHT_CHOICE_GLSL

struct Receiver {
    vec3 point;
    vec3 normal; // unit: light comes from its side alone
};

struct LightChoice {
    uint light;
    float chance; // 0 = none of the lights reaches the receiver
};

#endif
