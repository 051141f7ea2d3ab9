// A gallery with 500 small emitters: 250 square panels in the ceiling and 250 octahedra on strings, in eight
// colours and four radiances. 250 x 2 + 250 x 8 = 2500 emissive triangles.
#include "gallery.h"
#include "random.h"
#include "scenes.h"

#include <array>
#include <fmt/format.h>

namespace irradia::scenes {

namespace {

constexpr uint32_t kPanelsAlong = 25, kPanelsAcross = 10;
constexpr uint32_t kStrings = 50, kLampsPerString = 5;

constexpr size_t kColors = 8, kRadiances = 4;

// One panel and one octahedron for each of the lamps' materials, eight colours after one another.
struct LampMeshes {
    std::vector<int> panels, octahedra;
};

LampMeshes addLampMeshes(GlbWriter& glb) {
    const std::array<glm::vec3, kColors> colors{{{1.0f, 0.85f, 0.65f},
                                                 {1.0f, 0.6f, 0.3f},
                                                 {1.0f, 0.25f, 0.2f},
                                                 {0.4f, 1.0f, 0.45f},
                                                 {0.3f, 0.75f, 1.0f},
                                                 {0.35f, 0.4f, 1.0f},
                                                 {0.9f, 0.4f, 1.0f},
                                                 {0.9f, 0.95f, 1.0f}}};
    const Mesh panel = quad({-0.06f, 0.0f, -0.06f}, {0.12f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.12f}); // facing down
    const Mesh drop = octahedron(0.045f);
    LampMeshes meshes;
    for (float radiance : std::array<float, kRadiances>{2.0f, 5.0f, 12.0f, 30.0f}) {
        for (size_t i = 0; i < colors.size(); i++) {
            const int material = glb.addMaterial({.name = fmt::format("lamp {} {}", i, radiance),
                                                  .baseColor = glm::vec3(0.0f),
                                                  .emission = colors[i] * radiance});
            meshes.panels.push_back(glb.addMesh("panel", panel, material));
            meshes.octahedra.push_back(glb.addMesh("drop", drop, material));
        }
    }
    return meshes;
}

void addLamps(GlbWriter& glb) {
    const LampMeshes meshes = addLampMeshes(glb);
    Random random(500);
    // Any radiance; colours change along the hall.
    const auto choose = [&](const std::vector<int>& list, float x) {
        const float along = (x - kGallery.lower.x) / (kGallery.upper.x - kGallery.lower.x);
        const float color = along * static_cast<float>(kColors) + random.between(-0.8f, 0.8f);
        const auto column = static_cast<size_t>(glm::clamp(color, 0.0f, static_cast<float>(kColors - 1)));
        const auto row = static_cast<size_t>(random.between(0.0f, static_cast<float>(kRadiances)));
        return list[row * kColors + column];
    };
    for (uint32_t i = 0; i < kPanelsAlong * kPanelsAcross; i++) {
        const float x = spread(i / kPanelsAcross, kPanelsAlong, kGallery.lower.x, kGallery.upper.x);
        const float z = spread(i % kPanelsAcross, kPanelsAcross, kGallery.lower.z, kGallery.upper.z);
        glb.addNode("panel", choose(meshes.panels, x), translation({x, kGallery.upper.y - 0.01f, z}));
    }
    const int cord = glb.addMaterial({.name = "cord", .baseColor = glm::vec3(0.15f)});
    const int cordMesh = glb.addMesh("cord", frustum(0.004f, 0.004f, 1.0f, 6), cord);
    for (uint32_t i = 0; i < kStrings; i++) {
        // Two rows along the hall's sides.
        const float x =
            spread(i / 2, kStrings / 2, kGallery.lower.x, kGallery.upper.x) + random.between(-0.1f, 0.1f);
        const float z = (i % 2 == 0 ? -1.0f : 1.0f) * random.between(1.8f, 2.3f);
        const float lowest = random.between(1.1f, 1.9f);
        glb.addNode("cord", cordMesh,
                    translation({x, lowest, z}) * scaling({1.0f, kGallery.upper.y + 0.05f - lowest, 1.0f}));
        for (uint32_t lamp = 0; lamp < kLampsPerString; lamp++) {
            const float y = spread(lamp, kLampsPerString, lowest - 0.1f, kGallery.upper.y - 0.2f);
            glb.addNode("drop", choose(meshes.octahedra, x),
                        translation({x, y, z}) * rotationY(random.between(0.0f, 90.0f)));
        }
    }
}

} // namespace

void writeLampGallery(const std::filesystem::path& folder) {
    GlbWriter glb;
    addGalleryShell(glb);
    addLamps(glb);
    addGalleryExhibits(glb);
    addGalleryCameras(glb);
    glb.write(folder / "lamp-gallery.glb");
}

} // namespace irradia::scenes
