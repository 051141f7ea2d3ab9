// Constants and small geometry helpers.
#ifndef IRRADIA_MATH_GLSL
#define IRRADIA_MATH_GLSL

const float kPi = 3.14159265358979;
const float kInvPi = 0.318309886183791;

float square(float x) { return x * x; }
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); } // Rec. 709

// (1 - x)^5 of Schlick's Fresnel (1994).
float schlickWeight(float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}

// Orthonormal basis around a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
struct Frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

Frame frameFromNormal(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return Frame(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

vec3 toLocal(Frame f, vec3 v) { return vec3(dot(v, f.tangent), dot(v, f.bitangent), dot(v, f.normal)); }
vec3 toWorld(Frame f, vec3 v) { return v.x * f.tangent + v.y * f.bitangent + v.z * f.normal; }

// Unit vector to and from two 16-bit snorms (octahedral map, Cigolle et al. 2014).
uint encodeOctahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = vec2(p.x >= 0.0 ? 1.0 - abs(p.y) : abs(p.y) - 1.0, p.y >= 0.0 ? 1.0 - abs(p.x) : abs(p.x) - 1.0);
    return packSnorm2x16(n.z >= 0.0 ? p : folded);
}

vec3 decodeOctahedral(uint code) {
    vec2 p = unpackSnorm2x16(code);
    vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float t = max(-v.z, 0.0);
    v.x += v.x >= 0.0 ? -t : t;
    v.y += v.y >= 0.0 ? -t : t;
    return normalize(v);
}

#endif
