// Whether a scene's surface is closed.
#pragma once

#include "engine/scene/scene.h"
#include <array>

namespace irradia {

std::array<glm::vec3, 3> corners(const Scene& scene, const Triangle& triangle);

// Directed edges a -> b without a b -> a for it, corners being one where their positions are bit-equal. A
// closed surface with one winding has none.
size_t unmatchedEdges(const Scene& scene);

} // namespace irradia
