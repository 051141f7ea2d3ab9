// Rays against a triangle and against the four boxes of a node.
// On a CPU that runs a subgroup as one vector, selects cost less than branches, and integer minima of floats' bits
// less than minima that must care for NaN.

// Barycentrics this far outside still hit, 16 roundings of 1: neighbours overlap, so that no ray slips between them. (More
// would close true gaps: of a wall of 1 km this is a millimetre.)
const float kEdgeTolerance = 1.0 / 1048576.0;

bool isTraceable(vec3 origin, vec3 direction) {
    vec3 sum = abs(origin) + abs(direction);
    return sum.x + sum.y + sum.z < 3.0e38 && dot(direction, direction) > 0.0; // false for NaN
}

// 1 / d with zero replaced by a tiny number: 0 * infinity must not occur.
vec3 safeReciprocal(vec3 d) {
    const float kTiny = 1e-20;
    return 1.0 / mix(d, vec3(kTiny), lessThan(abs(d), vec3(kTiny)));
}

// Moeller and Trumbore 1997, two-sided, tMin < t < tMax. A degenerate triangle is never hit: its u is NaN.
// `margin` is 8 roundings of the longer edge (shared/bvh.h): times the distance and over the determinant it bounds the
// error of u and v, which outgrows the fixed tolerance where triangles are thin, or small for their distance.
bool intersectTriangle(vec3 origin, vec3 direction, float tMin, float tMax, vec3 p0, vec3 e1, vec3 e2, float margin,
                       out float t, out float u, out float v) {
    vec3 p = cross(direction, e2);
    float inverse = 1.0 / dot(e1, p);
    vec3 s = origin - p0;
    vec3 q = cross(s, e1);
    u = dot(s, p) * inverse;
    v = dot(direction, q) * inverse;
    t = dot(e2, q) * inverse;
    float tolerance = kEdgeTolerance + (abs(s.x) + abs(s.y) + abs(s.z)) * abs(margin * inverse);
    return min(u, v) >= -tolerance && u + v <= 1.0 + tolerance && t > tMin && t < tMax;
}

vec4 unpackBytes(uint word) {
    return vec4(ivec4(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24));
}

// Bits of t = q * scale + bias for four q.
const int kLateBits = 4; // of 2^-23 to 2^-24 each
ivec4 planeBits(uint word, float scale, float bias) { return floatBitsToInt(unpackBytes(word) * scale + bias); }

// Where a ray enters four boxes, in bits of the distance: >= 0, and more than `leave` where it misses. As integers,
// negative distances sort below 0, and all others as they do as floats. Rays leave late by what distances to the planes of
// a box afar may err, 8 roundings; of one nearby, the builder has made the box larger (Ize 2013, "Robust BVH Ray
// Traversal").
void intersectBoxes(uvec4 node0, uvec4 node1, uvec4 node2, vec3 origin, vec3 reciprocal, float tMax,
                    out ivec4 enter, out ivec4 leave) {
    const uint kExponent = 0x7f800000u;
    vec3 scale = uintBitsToFloat(uvec3(node0.w << 23, node0.w << 15, node0.w << 7) & kExponent) * reciprocal;
    vec3 bias = (uintBitsToFloat(node0.xyz) - origin) * reciprocal;
    bvec3 backwards = lessThan(reciprocal, vec3(0.0));
    uvec3 lower = node1.xyz;
    uvec3 upper = uvec3(node1.w, node2.xy);
    uvec3 near = mix(lower, upper, backwards);
    uvec3 far = mix(upper, lower, backwards);
    enter = max(max(planeBits(near.x, scale.x, bias.x), planeBits(near.y, scale.y, bias.y)),
                max(planeBits(near.z, scale.z, bias.z), ivec4(0)));
    leave = min(min(planeBits(far.x, scale.x, bias.x), planeBits(far.y, scale.y, bias.y)),
                min(planeBits(far.z, scale.z, bias.z), ivec4(floatBitsToInt(tMax)))) + ivec4(kLateBits);
}

uvec2 ordered(uint a, uint b) { return uvec2(min(a, b), max(a, b)); }

uvec4 sorted(uvec4 v) {
    v.xy = ordered(v.x, v.y);
    v.zw = ordered(v.z, v.w);
    v.xz = ordered(v.x, v.z);
    v.yw = ordered(v.y, v.w);
    v.yz = ordered(v.y, v.z);
    return v;
}
