// The rays of `bench rays`: what the first two segments of a path tracer send through a scene.
#pragma once

#include "embree_scene.h"
#include <vector>

namespace irradia {

struct BenchRaySets {
    std::vector<BenchRay> primary; // through every pixel of the camera, in rows
    std::vector<BenchRay> bounce;  // one cosine-distributed bounce from each hit of those
    std::vector<BenchRay>
        shadow; // from the same hits to points on emitters, or in the bounds where there are none
};

BenchRaySets makeRaySets(const Scene& scene, const Camera& camera, glm::uvec2 size,
                         const EmbreeScene& embree);

} // namespace irradia
