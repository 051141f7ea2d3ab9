// How far rounding may take points, and rays' hits, off the plane of a triangle. Rays start, and end, that far from the
// surfaces they join: by an error of the hit itself, whatever the size and place of the scene (as Waechter and Binder 2019,
// "A Fast and Robust Method for Avoiding Self-Intersection", and Pharr et al. 2023, section 6.8, ask for; the bounds are
// those of our own arithmetic, intersectTriangle's among it).
#ifndef IRRADIA_PLANE_ERROR_GLSL
#define IRRADIA_PLANE_ERROR_GLSL
#include "lib/math.glsl"

const float kRounding = 1.0 / 16777216.0; // relative, of one operation: 2^-24

// A determinant with all its terms taken positive: what its rounding errors are proportional to.
float permanent(vec3 a, vec3 b, vec3 c) {
    return a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z) + a.z * (b.x * c.y + b.y * c.x);
}

// Of p0 + u e1 + v e2 off the plane, and of moving it along the normal: each axis rounds five times. `reach` is
// |u e1| + |v e2| of each axis, `point` what was computed.
float pointError(vec3 normal, vec3 p0, vec3 reach, vec3 point) {
    return kRounding * dot(abs(normal), abs(p0) + 2.0 * (reach + abs(point)));
}

// Of the height over the plane that a ray's hit goes by, where rays begin up to `reach` from p0, for each axis: that height
// times doubleArea, the length of cross(e1, e2), is the determinant of (origin - p0, e1, e2), whose terms round six times.
// Slivers have no plane to speak of: theirs is cut. A plane may err by nothing, as those along the axes do: the last
// term is for its neighbours.
float heightError(vec3 e1, vec3 e2, float doubleArea, vec3 reach) {
    const float kSliver = 1024.0;
    float longest = maxComponent(reach);
    return kRounding * (6.0 * min(permanent(reach, abs(e1), abs(e2)) / doubleArea, kSliver * longest) + longest);
}

// Of a ray that shall end before a plane: its point at `distance`, met at `cosine` > 0, and hits of it err by `error`.
float lengthBefore(float distance, float cosine, float error) {
    return distance * (1.0 - 4.0 * kRounding) - error / max(cosine, 1e-6);
}

#endif
