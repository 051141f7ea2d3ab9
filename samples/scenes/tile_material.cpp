#include "tile_material.h"

#include "textures.h"

namespace irradia::scenes {

int addTiles(GlbWriter& glb, glm::vec3 light, glm::vec3 dark) {
    const TileTextures pictures = tiles(512, light, dark);
    return glb.addMaterial(
        {.name = "tiles",
         .baseColor = glm::vec3(1.0f),
         .metallic = 1.0f, // times the texture's 0
         .baseColorTexture = glb.addTexture("tile colour", pictures.baseColor),
         .metallicRoughnessTexture = glb.addTexture("tile roughness", pictures.metallicRoughness),
         .normalTexture = glb.addTexture("tile normals", pictures.normal)});
}

} // namespace irradia::scenes
