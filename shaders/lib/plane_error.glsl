// How far rounding may take points, and rays' hits, off the plane of a triangle. Rays start, and end, that far from the
// surfaces they join: by an error of the hit itself, whatever the size and place of the scene (as Waechter and Binder 2019,
// "A Fast and Robust Method for Avoiding Self-Intersection", and Pharr et al. 2023, section 6.8, ask for; the bound is
// that of intersectTriangle's arithmetic).
#ifndef IRRADIA_PLANE_ERROR_GLSL
#define IRRADIA_PLANE_ERROR_GLSL
#include "lib/math.glsl"

const float kRounding = 1.0 / 16777216.0; // relative, of one operation: 2^-24

// A determinant with all its terms taken positive: what its rounding errors are proportional to.
float permanent(vec3 a, vec3 b, vec3 c) {
    return a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z) + a.z * (b.x * c.y + b.y * c.x);
}

// Of a point of the triangle that was computed from barycentrics, and of hits of rays that begin up to `reach` from its
// first corner (per axis). `normal` is unit, `doubleArea` the length of cross(e1, e2).
//   The point: p0 + u e1 + v e2, and the origin that it is moved to, round each axis by less than 4 parts of its terms.
//   The hit: t's numerator, the determinant of (origin - p0, e1, e2), is the height over the plane times doubleArea, and
//   errs by less than 8 parts of its permanent. Slivers have no plane to speak of: theirs is cut.
//   The last term keeps a neighbour's error away, where the plane's own happens to be none.
float planeError(vec3 p0, vec3 e1, vec3 e2, vec3 normal, float doubleArea, vec3 reach) {
    const float kSliver = 1024.0;
    float point = dot(abs(normal), abs(p0) + reach);
    float hit = min(permanent(reach, abs(e1), abs(e2)) / doubleArea, kSliver * maxComponent(reach));
    return kRounding * (4.0 * point + 8.0 * hit + maxComponent(reach));
}

#endif
