#version 460
#extension GL_GOOGLE_include_directive : require
// Rays that leave a triangle, and rays that end before one, against that triangle itself.
#include "lib/kernel.glsl"
#include "lib/intersect.glsl"
#include "lib/plane_error.glsl"
#include "shared/bvh.h"
#include "harness.h"

QUADS_READ(0, cases); // 4 each: p0 and u, e1 and v, e2, and a direction to leave by or, at its w, to come from
QUADS_WRITE(1, results); // t of the hit (0 = none), error, length of the ray that ends before, distance
layout(push_constant) uniform Push { PlaneErrorParams params; };

layout(constant_id = 40) const float kErrorFault = 1.0; // 1 leaves the bounds as they are

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) return;
    vec4 a = uintBitsToFloat(loadQuad(cases, 4u * i));
    vec4 b = uintBitsToFloat(loadQuad(cases, 4u * i + 1u));
    vec3 p0 = a.xyz;
    vec3 e1 = b.xyz;
    vec3 e2 = uintBitsToFloat(loadQuad(cases, 4u * i + 2u)).xyz;
    vec4 way = uintBitsToFloat(loadQuad(cases, 4u * i + 3u));
    vec3 normal = cross(e1, e2);
    float doubleArea = length(normal);
    normal /= doubleArea;
    vec3 point = p0 + a.w * e1 + b.w * e2;
    vec3 reach = abs(a.w * e1) + abs(b.w * e2);

    vec3 origin;
    vec3 direction;
    float error;
    float tMax = 1e30;
    float distance = 0.0;
    if (way.w == 0.0) {
        normal = dot(normal, way.xyz) > 0.0 ? normal : -normal;
        error = kErrorFault * (pointError(normal, p0, reach, point) + heightError(e1, e2, doubleArea, reach));
        origin = point + error * normal;
        direction = way.xyz;
    } else {
        origin = point + way.w * way.xyz;
        vec3 to = point - origin;
        distance = length(to);
        direction = to / distance;
        error = kErrorFault * (pointError(normal, p0, reach, point) + heightError(e1, e2, doubleArea, reach + abs(to)));
        tMax = lengthBefore(distance, abs(dot(normal, direction)), error);
    }
    float t, u, v;
    float margin = 8.0 * kRounding * max(length(e1), length(e2));
    bool hit = intersectTriangle(origin, direction, 0.0, tMax, p0, e1, e2, margin, t, u, v);
    storeQuad(results, i, floatBitsToUint(vec4(hit ? t : 0.0, error, tMax, distance)));
}
