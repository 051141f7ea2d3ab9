// The material of floors of ceramic tiles.
#pragma once

#include "glb_writer.h"

namespace irradia::scenes {

// With the pictures of textures.h's tiles; the material's index.
int addTiles(GlbWriter& glb, glm::vec3 light, glm::vec3 dark);

} // namespace irradia::scenes
