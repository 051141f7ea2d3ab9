#include "gallery.h"

#include <array>

namespace irradia::scenes {

float spread(uint32_t i, uint32_t n, float lower, float upper) {
    return lower + (upper - lower) * (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
}

void addGalleryShell(GlbWriter& glb) {
    const int wall = glb.addMaterial({.name = "wall", .baseColor = {0.7f, 0.69f, 0.67f}});
    const int floor =
        glb.addMaterial({.name = "floor", .baseColor = {0.25f, 0.24f, 0.23f}, .roughness = 0.25f});
    glb.add("floor", kGallery.floor(), floor);
    glb.add("ceiling", kGallery.ceiling(), wall);
    glb.add("wall -x", kGallery.wallNegativeX(), wall);
    glb.add("wall +x", kGallery.wallPositiveX(), wall);
    glb.add("wall -z", kGallery.wallNegativeZ(), wall);
    glb.add("wall +z", kGallery.wallPositiveZ(), wall);
}

void addGalleryExhibits(GlbWriter& glb) {
    const int stone =
        glb.addMaterial({.name = "stone", .baseColor = {0.6f, 0.58f, 0.55f}, .roughness = 0.7f});
    const std::array exhibitMaterials{
        glb.addMaterial({.name = "plaster", .baseColor = glm::vec3(0.8f)}),
        glb.addMaterial(
            {.name = "bronze", .baseColor = {0.8f, 0.55f, 0.35f}, .metallic = 1.0f, .roughness = 0.3f}),
        glb.addMaterial({.name = "porcelain", .baseColor = {0.75f, 0.75f, 0.72f}, .roughness = 0.1f}),
        glb.addMaterial(
            {.name = "silver", .baseColor = {0.95f, 0.93f, 0.88f}, .metallic = 1.0f, .roughness = 0.15f}),
    };
    const int pedestal = glb.addMesh("pedestal", roundedBox({0.25f, 0.45f, 0.25f}, 0.02f, 3), stone);
    const std::array<glm::vec2, 12> amphora{{{0.0f, 0.0f},
                                             {0.08f, 0.0f},
                                             {0.06f, 0.04f},
                                             {0.15f, 0.2f},
                                             {0.18f, 0.34f},
                                             {0.12f, 0.48f},
                                             {0.06f, 0.56f},
                                             {0.1f, 0.62f},
                                             {0.08f, 0.62f},
                                             {0.04f, 0.55f},
                                             {0.1f, 0.4f},
                                             {0.0f, 0.1f}}};
    const std::array shapes{lathe(amphora, 48), sphere(0.22f, 48, 24),
                            roundedBox(glm::vec3(0.17f), 0.05f, 5)};
    for (uint32_t i = 0; i < 12; i++) {
        const float x = spread(i / 2, 6, kGallery.lower.x, kGallery.upper.x);
        const float z = i % 2 == 0 ? -1.0f : 1.0f;
        glb.addNode("pedestal", pedestal, translation({x, 0.4505f, z}));
        const uint32_t shape = i % 3;
        const float lift = std::array{0.0f, 0.22f, 0.17f}[shape];
        glb.add("exhibit", shapes[shape], exhibitMaterials[(i / 2 + i) % 4],
                translation({x, 0.901f + lift, z}) * rotationY(20.0f * static_cast<float>(i)));
    }
}

void addGalleryCameras(GlbWriter& glb) {
    glb.addCamera("along", {-5.7f, 1.65f, 0.35f}, {0.0f, 1.25f, 0.0f}, 58.0f);
    glb.addCamera("across", {-2.0f, 1.6f, 1.65f}, {1.0f, 1.2f, -1.2f}, 60.0f);
}

} // namespace irradia::scenes
