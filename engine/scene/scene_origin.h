// Where a scene's coordinates begin, so that floats resolve it wherever its file puts it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace irradia {

// The median of the points, axis by axis, to a step of half to once their median distance from it (the
// largest of three axes): no stray object moves it. Scenes about their own origin, which lies within 32 such
// distances, stay where they are, to the bit.
glm::dvec3 sceneOrigin(const std::vector<glm::dvec3>& points);

} // namespace irradia
