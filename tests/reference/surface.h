// What a ray meets: the point, its normals, its emission and its BSDF, with all textures applied.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/bsdf.h"
#include "tests/reference/bvh.h"

namespace irradia::reference {

struct SurfacePoint {
    Vec3 position{0.0};
    Vec3 geometricNormal{0.0}; // on the side of V
    double offset = 0.0;       // by which rays that leave must begin off the plane: roundings of its corners
    Frame shading{Vec3(0, 0, 1)};
    Vec3 view{0.0}; // V in the shading frame; z >= about 0.01
    Bsdf bsdf{BsdfParameters{}};

    // f(V, L) N.L for a world direction; 0 below the geometric or the shading horizon.
    Vec3 scattered(const Vec3& direction) const;
    double pdf(const Vec3& direction) const; // of sampling it, without regard to the geometric horizon
};

// Corners of every triangle of the scene in double precision.
std::vector<TriangleShape> triangleShapes(const Scene& scene);

SurfacePoint surfaceAt(const Scene& scene, const TriangleShape& shape, const Ray& ray, const Hit& hit);

// Radiance that leaves a triangle's point (u, v) towards its front or back; 0 from the back of a single-sided
// material.
Vec3 emittedRadiance(const Scene& scene, uint32_t triangle, const Vec2& uv, bool front);

} // namespace irradia::reference
