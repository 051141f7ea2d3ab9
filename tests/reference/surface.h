// What a ray meets: the point, its normals, its emission and its BSDF, with all textures applied.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/bvh.h"
#include "tests/reference/glass.h"
#include "tests/reference/media.h"
#include <optional>

namespace irradia::reference {

struct SurfacePoint {
    Vec3 position{0.0};
    Vec3 geometricNormal{0.0}; // on the side of V
    double offset = 0.0;       // by which rays that leave must begin off the plane: roundings of its corners
    Frame shading{Vec3(0, 0, 1)};
    Vec3 view{0.0}; // V in the shading frame; z >= about 0.01
    Bsdf bsdf{BsdfParameters{}};
    std::optional<Glass> glass{}; // instead of bsdf, of what transmits
    MediaBySide media{};

    // Is the world direction on one and the same side of the surface and of its shading normal? Else nothing
    // is scattered to it.
    bool isValid(const Vec3& direction) const;
    bool isBeyond(const Vec3& direction) const { return glm::dot(geometricNormal, direction) < 0.0; }

    // f(V, L) |N.L| for a world direction.
    Vec3 scattered(const Vec3& direction) const;
    // The part of it that shows light without extent: all lobes, but of smooth surfaces the Lambert one.
    Vec3 scatteredPunctual(const Vec3& direction) const;
    double pdf(const Vec3& direction) const; // of sampling it, without regard to the geometric horizon
    BsdfSample sample(double uLobe, const Vec2& u) const; // the direction in the world

    double alpha() const { return bsdf.alpha(); }
    const Media& mediaTowards(const Vec3& direction) const {
        return isBeyond(direction) ? media.there : media.here;
    }
    // Origin of rays that leave in a direction, and on V's side.
    Vec3 beforeIt() const { return position + offset * geometricNormal; }
    Vec3 leave(const Vec3& direction) const {
        return position + (isBeyond(direction) ? -offset : offset) * geometricNormal;
    }
    // Radiance times it is a share of light: the square of the ratio of indices, 1 on V's side.
    double etendue(const Vec3& direction) const;
};

// Corners of every triangle of the scene in double precision.
std::vector<TriangleShape> triangleShapes(const Scene& scene);

// `media`: around the ray's origin.
SurfacePoint surfaceAt(const Scene& scene, const TriangleShape& shape, const Ray& ray, const Hit& hit,
                       const Media& media = {});

// Does the ray meet the side from which the corners are counter-clockwise?
bool isFront(const TriangleShape& shape, const Ray& ray);

// Radiance that leaves a triangle's point (u, v) towards its front or back, by the share of it that is there;
// 0 from the back of a single-sided material.
Vec3 emittedRadiance(const Scene& scene, uint32_t triangle, const Vec2& uv, bool front);

} // namespace irradia::reference
