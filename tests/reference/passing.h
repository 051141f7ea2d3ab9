// Light that passes straight on where a ray meets a surface: through the share of a point that is not there,
// and through clear sheets. It makes no vertex of the path.
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/bvh.h"
#include "tests/reference/math.h"

namespace irradia::reference {

struct Passing {
    double coverage = 1.0; // c: scales what the surface emits and scatters
    Vec3 share{0.0};       // P = (1 - c) + c T
};

// A sheet that transmits so smoothly that light goes straight on; by the material's factors alone.
bool isClearSheet(const Material& material);

// May a ray pass somewhere through the material?
bool letsPass(const Material& material);

Passing passingAt(const Scene& scene, const TriangleShape& shape, const Ray& ray, const Hit& hit);

} // namespace irradia::reference
