// A gallery with 500 small emitters: 250 square panels in the ceiling and 250 octahedra on strings, in eight
// colours and four radiances. 250 x 2 + 250 x 8 = 2500 emissive triangles.
#include "random.h"
#include "room.h"
#include "scenes.h"

#include <array>
#include <fmt/format.h>

namespace irradia::scenes {

namespace {

constexpr Room kHall{{-6.0f, 0.0f, -2.5f}, {6.0f, 3.6f, 2.5f}};
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

// Where step i of n lies between two ends, half a step from each.
float spread(uint32_t i, uint32_t n, float lower, float upper) {
    return lower + (upper - lower) * (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
}

void addLamps(GlbWriter& glb) {
    const LampMeshes meshes = addLampMeshes(glb);
    Random random(500);
    // Any radiance; colours change along the hall.
    const auto choose = [&](const std::vector<int>& list, float x) {
        const float along = (x - kHall.lower.x) / (kHall.upper.x - kHall.lower.x);
        const float color = along * static_cast<float>(kColors) + random.between(-0.8f, 0.8f);
        const auto column = static_cast<size_t>(glm::clamp(color, 0.0f, static_cast<float>(kColors - 1)));
        const auto row = static_cast<size_t>(random.between(0.0f, static_cast<float>(kRadiances)));
        return list[row * kColors + column];
    };
    for (uint32_t i = 0; i < kPanelsAlong * kPanelsAcross; i++) {
        const float x = spread(i / kPanelsAcross, kPanelsAlong, kHall.lower.x, kHall.upper.x);
        const float z = spread(i % kPanelsAcross, kPanelsAcross, kHall.lower.z, kHall.upper.z);
        glb.addNode("panel", choose(meshes.panels, x), translation({x, kHall.upper.y - 0.01f, z}));
    }
    const int cord = glb.addMaterial({.name = "cord", .baseColor = glm::vec3(0.15f)});
    const int cordMesh = glb.addMesh("cord", frustum(0.004f, 0.004f, 1.0f, 6), cord);
    for (uint32_t i = 0; i < kStrings; i++) {
        // Two rows along the hall's sides.
        const float x =
            spread(i / 2, kStrings / 2, kHall.lower.x, kHall.upper.x) + random.between(-0.1f, 0.1f);
        const float z = (i % 2 == 0 ? -1.0f : 1.0f) * random.between(1.8f, 2.3f);
        const float lowest = random.between(1.1f, 1.9f);
        glb.addNode("cord", cordMesh,
                    translation({x, lowest, z}) * scaling({1.0f, kHall.upper.y + 0.05f - lowest, 1.0f}));
        for (uint32_t lamp = 0; lamp < kLampsPerString; lamp++) {
            const float y = spread(lamp, kLampsPerString, lowest - 0.1f, kHall.upper.y - 0.2f);
            glb.addNode("drop", choose(meshes.octahedra, x),
                        translation({x, y, z}) * rotationY(random.between(0.0f, 90.0f)));
        }
    }
}

void addShell(GlbWriter& glb) {
    const int wall = glb.addMaterial({.name = "wall", .baseColor = {0.7f, 0.69f, 0.67f}});
    const int floor =
        glb.addMaterial({.name = "floor", .baseColor = {0.25f, 0.24f, 0.23f}, .roughness = 0.25f});
    glb.add("floor", kHall.floor(), floor);
    glb.add("ceiling", kHall.ceiling(), wall);
    glb.add("wall -x", kHall.wallNegativeX(), wall);
    glb.add("wall +x", kHall.wallPositiveX(), wall);
    glb.add("wall -z", kHall.wallNegativeZ(), wall);
    glb.add("wall +z", kHall.wallPositiveZ(), wall);
}

void addExhibits(GlbWriter& glb) {
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
        const float x = spread(i / 2, 6, kHall.lower.x, kHall.upper.x);
        const float z = i % 2 == 0 ? -1.0f : 1.0f;
        glb.addNode("pedestal", pedestal, translation({x, 0.4505f, z}));
        const uint32_t shape = i % 3;
        const float lift = std::array{0.0f, 0.22f, 0.17f}[shape];
        glb.add("exhibit", shapes[shape], exhibitMaterials[(i / 2 + i) % 4],
                translation({x, 0.901f + lift, z}) * rotationY(20.0f * static_cast<float>(i)));
    }
}

} // namespace

void writeLampGallery(const std::filesystem::path& folder) {
    GlbWriter glb;
    addShell(glb);
    addLamps(glb);
    addExhibits(glb);
    glb.addCamera("along", {-5.7f, 1.65f, 0.35f}, {0.0f, 1.25f, 0.0f}, 58.0f);
    glb.addCamera("across", {-2.0f, 1.6f, 1.65f}, {1.0f, 1.2f, -1.2f}, 60.0f);
    glb.write(folder / "lamp-gallery.glb");
}

} // namespace irradia::scenes
