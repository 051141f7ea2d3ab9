// Furniture of the interior, each standing on y = 0 about its own origin, fronts towards +z, placed by a
// matrix.
#pragma once

#include "glb_writer.h"

namespace irradia::scenes {

// Three seats; 2.2 wide, 0.95 deep.
struct SofaMaterials {
    int fabric, cushion, wood;
};
void addSofa(GlbWriter& glb, const glm::mat4& place, SofaMaterials materials);

// A round table of 1.1 diameter, 0.75 high, on one turned leg.
void addRoundTable(GlbWriter& glb, const glm::mat4& place, int wood);

// A chair is one mesh: `chairMesh` once, then nodes.
int addChairMesh(GlbWriter& glb, int wood, int fabric);

// 1.3 by 0.7, 0.4 high.
void addCoffeeTable(GlbWriter& glb, const glm::mat4& place, int wood, int metal);

// 1.6 wide, 2.1 high, 0.3 deep, five shelves full of books in the given materials.
void addBookshelf(GlbWriter& glb, const glm::mat4& place, int wood, std::span<const int> bookMaterials);

struct PlantMaterials {
    int pot, soil, bark, leaf;
};
void addPlant(GlbWriter& glb, const glm::mat4& place, PlantMaterials materials);

// `width` along x, hanging from `top` to just above the floor.
void addCurtain(GlbWriter& glb, const glm::mat4& place, float width, float top, int cloth);

// A bowl with six fruits.
void addFruitBowl(GlbWriter& glb, const glm::mat4& place, int bowl, std::span<const int> fruitMaterials);

} // namespace irradia::scenes
