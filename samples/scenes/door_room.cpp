// A room lit only through a door ajar: the lamp hangs next door on the wall that both rooms share and looks
// away from it, so that no point of the first room sees it and all light arrives after at least one bounce.
#include "room.h"
#include "scenes.h"

#include <array>

namespace irradia::scenes {

namespace {

// The camera's room is x < 0, the lit one x > kWallThickness.
constexpr Room kDark{{-4.2f, 0.0f, -2.4f}, {0.0f, 2.7f, 2.4f}};
constexpr Room kLit{{kWallThickness, 0.0f, -2.4f}, {3.6f, 2.7f, 2.4f}};
constexpr float kDoorWidth = 0.9f, kDoorHeight = 2.05f, kDoorAngle = 52.0f, kHingeZ = -1.1f;

struct Materials {
    int wall, litWall, floor, wood, brass, steel, glaze, clay, plaster, lamp, case_;
};

Materials addMaterials(GlbWriter& glb) {
    return {
        .wall = glb.addMaterial({.name = "wall", .baseColor = {0.8f, 0.78f, 0.74f}}),
        .litWall = glb.addMaterial({.name = "lit wall", .baseColor = {0.85f, 0.79f, 0.68f}}),
        .floor = glb.addMaterial({.name = "floor", .baseColor = {0.38f, 0.25f, 0.16f}, .roughness = 0.35f}),
        .wood = glb.addMaterial({.name = "wood", .baseColor = {0.5f, 0.33f, 0.2f}, .roughness = 0.5f}),
        .brass = glb.addMaterial(
            {.name = "brass", .baseColor = {0.89f, 0.7f, 0.38f}, .metallic = 1.0f, .roughness = 0.3f}),
        .steel = glb.addMaterial(
            {.name = "steel", .baseColor = {0.66f, 0.66f, 0.68f}, .metallic = 1.0f, .roughness = 0.2f}),
        .glaze = glb.addMaterial({.name = "glaze", .baseColor = {0.12f, 0.25f, 0.55f}, .roughness = 0.15f}),
        .clay = glb.addMaterial({.name = "clay", .baseColor = {0.65f, 0.3f, 0.2f}}),
        .plaster = glb.addMaterial({.name = "plaster", .baseColor = glm::vec3(0.8f)}),
        .lamp = glb.addMaterial(
            {.name = "lamp", .baseColor = glm::vec3(0.0f), .emission = {150.0f, 132.0f, 108.0f}}),
        .case_ = glb.addMaterial({.name = "lamp case", .baseColor = glm::vec3(0.3f)}),
    };
}

void addShell(GlbWriter& glb, const Materials& m) {
    const Room both{kDark.lower, kLit.upper};
    glb.add("floor", both.floor(), m.floor);
    glb.add("ceiling", both.ceiling(), m.wall);
    glb.add("dark room's wall -x", kDark.wallNegativeX(), m.wall);
    glb.add("wall -z", both.wallNegativeZ(), m.wall);
    glb.add("wall +z", both.wallPositiveZ(), m.wall);
    glb.add("lit room's wall +x", kLit.wallPositiveX(), m.litWall);
    // The doorway reaches into the floor's slab, which fills it there.
    const Rectangle doorway{{kHingeZ, -0.05f}, {kHingeZ + kDoorWidth, kDoorHeight}};
    glb.add("partition", kLit.wallNegativeXWithOpening(doorway), m.wall);

    const glm::vec3 corner(kWallThickness + 0.05f, 0.5f, 0.6f);
    glb.add("lamp case", box({kWallThickness - 0.05f, 0.45f, 0.55f}, {kWallThickness + 0.045f, 2.05f, 2.05f}),
            m.case_);
    glb.add("lamp", quad(corner + glm::vec3(0.0f, 0.0f, 1.4f), {0.0f, 0.0f, -1.4f}, {0.0f, 1.5f, 0.0f}),
            m.lamp);
}

void addDoor(GlbWriter& glb, const Materials& m) {
    // Hung at its edge on the dark room's side, opening into the dark room.
    const glm::mat4 hung = translation({0.0f, 0.0f, kHingeZ}) * rotationY(-kDoorAngle);
    const glm::vec3 half(0.02f, 0.5f * kDoorHeight - 0.01f, 0.5f * kDoorWidth - 0.01f);
    glb.add("door", roundedBox(half, 0.006f, 3), m.wood,
            hung * translation({-0.025f, half.y + 0.015f, half.z + 0.01f}));
    const int knob = glb.addMesh("knob", sphere(0.035f, 32, 16), m.brass);
    const int spindle = glb.addMesh("spindle", frustum(0.012f, 0.012f, 0.13f, 16), m.brass);
    for (float side : {-0.065f, 0.065f})
        glb.addNode("knob", knob, hung * translation({-0.025f + side, 1.0f, kDoorWidth - 0.09f}));
    glb.addNode("spindle", spindle, hung * translation({0.04f, 1.0f, kDoorWidth - 0.09f}) * rotationZ(90.0f));
}

void addThings(GlbWriter& glb, const Materials& m) {
    const glm::mat4 place = translation({-1.75f, 0.0f, 0.55f}) * rotationY(18.0f);
    glb.add("table top", roundedBox({0.65f, 0.025f, 0.42f}, 0.012f, 3), m.wood,
            place * translation({0.0f, 0.72f, 0.0f}));
    const int leg = glb.addMesh("leg", frustum(0.02f, 0.032f, 0.7f, 20), m.wood);
    for (float x : {-0.57f, 0.57f})
        for (float z : {-0.34f, 0.34f}) glb.addNode("leg", leg, place * translation({x, 0.0f, z}));

    const std::array<glm::vec2, 16> vase{{{0.0f, 0.0f},
                                          {0.06f, 0.0f},
                                          {0.085f, 0.03f},
                                          {0.115f, 0.1f},
                                          {0.12f, 0.16f},
                                          {0.1f, 0.23f},
                                          {0.06f, 0.29f},
                                          {0.045f, 0.33f},
                                          {0.05f, 0.37f},
                                          {0.07f, 0.4f},
                                          {0.06f, 0.4f},
                                          {0.04f, 0.36f},
                                          {0.036f, 0.33f},
                                          {0.08f, 0.22f},
                                          {0.09f, 0.08f},
                                          {0.0f, 0.02f}}};
    const float onTable = 0.7455f;
    glb.add("vase", lathe(vase, 48), m.glaze, place * translation({-0.3f, onTable, -0.05f}));
    glb.add("steel ball", sphere(0.13f, 48, 24), m.steel,
            place * translation({0.06f, onTable + 0.13f, 0.12f}));
    glb.add("plaster cone", frustum(0.13f, 0.0f, 0.32f, 48), m.plaster,
            place * translation({0.4f, onTable, -0.1f}));
    glb.add("clay ball", sphere(0.3f, 48, 24), m.clay, translation({-0.85f, 0.3f, 1.65f}));
    glb.add("crate", roundedBox(glm::vec3(0.26f), 0.02f, 3), m.plaster,
            translation({-3.3f, 0.2605f, -1.7f}) * rotationY(25.0f));
}

} // namespace

void writeDoorRoom(const std::filesystem::path& folder) {
    GlbWriter glb;
    const Materials materials = addMaterials(glb);
    addShell(glb, materials);
    addDoor(glb, materials);
    addThings(glb, materials);
    glb.addCamera("camera", {-3.95f, 1.5f, 1.35f}, {-0.6f, 0.85f, -0.1f}, 52.0f);
    glb.write(folder / "door-room.glb");
}

} // namespace irradia::scenes
