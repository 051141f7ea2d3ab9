// Where a scene's coordinates begin, so that floats resolve it wherever its file puts it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace irradia {

// The median of the points, axis by axis: no stray object moves it. It is rounded to a step of 4 to 8 times
// their median distance from it (the largest of three axes): that costs floats three bits at most, keeps
// coordinates exact that were, and leaves scenes alone that stand about their own origin.
glm::dvec3 sceneOrigin(const std::vector<glm::dvec3>& points);

} // namespace irradia
