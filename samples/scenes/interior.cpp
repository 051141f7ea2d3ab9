// A furnished living room of about 100 k triangles, lit by an area light outside the window and a ceiling
// lamp.
#include "furniture.h"
#include "room.h"
#include "scenes.h"
#include "textures.h"

#include <array>

namespace irradia::scenes {

namespace {

constexpr Room kRoom{{-3.0f, 0.0f, -2.3f}, {3.0f, 2.7f, 2.5f}};
constexpr Rectangle kWindow{{-1.2f, 0.75f}, {0.8f, 2.25f}}; // (z, y) in the wall at lower.x

void addShell(GlbWriter& glb) {
    const int wall = glb.addMaterial({.name = "wall", .baseColor = {0.75f, 0.72f, 0.66f}});
    const int accent = glb.addMaterial({.name = "accent wall", .baseColor = {0.32f, 0.42f, 0.4f}});
    const int white =
        glb.addMaterial({.name = "white paint", .baseColor = glm::vec3(0.8f), .roughness = 0.4f});
    glb.add("slab", kRoom.floor(), wall);
    glb.add("ceiling", kRoom.ceiling(), white);
    glb.add("wall +x", kRoom.wallPositiveX(), wall);
    glb.add("wall -z", kRoom.wallNegativeZ(), accent);
    glb.add("wall +z", kRoom.wallPositiveZ(), wall);
    glb.add("window wall", kRoom.wallNegativeXWithOpening(kWindow), wall);
    const float x = kRoom.lower.x - 0.1f, z = 0.5f * (kWindow.lower.x + kWindow.upper.x);
    glb.add("mullion",
            box({x, kWindow.lower.y - 0.05f, z - 0.025f}, {x + 0.04f, kWindow.upper.y + 0.05f, z + 0.025f}),
            white);
    glb.add("skirting",
            box({kRoom.lower.x - 0.05f, -0.05f, kRoom.lower.z - 0.05f},
                {kRoom.upper.x + 0.05f, 0.08f, kRoom.lower.z + 0.012f}),
            white);

    const int boards = glb.addMaterial(
        {.name = "floor boards",
         .baseColor = glm::vec3(1.0f),
         .roughness = 0.4f,
         .baseColorTexture = glb.addTexture("boards", floorBoards(512, {0.62f, 0.42f, 0.26f}))});
    glb.add("floor",
            quad({kRoom.lower.x - 0.05f, 0.002f, kRoom.upper.z + 0.05f}, {6.1f, 0.0f, 0.0f},
                 {0.0f, 0.0f, -4.9f}, {3.0f, 4.0f}),
            boards);
}

void addLights(GlbWriter& glb) {
    const int sky = glb.addMaterial(
        {.name = "window light", .baseColor = glm::vec3(0.0f), .emission = {8.0f, 9.0f, 10.0f}});
    const int bulb =
        glb.addMaterial({.name = "bulb", .baseColor = glm::vec3(0.0f), .emission = {45.0f, 34.0f, 22.0f}});
    const int shade = glb.addMaterial({.name = "lamp shade", .baseColor = {0.75f, 0.68f, 0.55f}});
    // The window light fills the opening's outer end.
    const glm::vec2 opening = kWindow.upper - kWindow.lower;
    glb.add("window light",
            quad({kRoom.lower.x - kWallThickness + 0.01f, kWindow.lower.y, kWindow.upper.x},
                 {0.0f, 0.0f, -opening.x}, {0.0f, opening.y, 0.0f}),
            sky);
    const glm::mat4 hanging = translation({0.2f, 1.95f, -0.1f});
    // A cone's frustum open at both ends: an outline that returns to its start.
    const std::array<glm::vec2, 7> outline{{{0.26f, 0.0f},
                                            {0.19f, 0.15f},
                                            {0.11f, 0.28f},
                                            {0.1f, 0.28f},
                                            {0.18f, 0.15f},
                                            {0.252f, 0.0f},
                                            {0.26f, 0.0f}}};
    glb.add("lamp shade", lathe(outline, 64), shade, hanging);
    glb.add("bulb", icosphere(2), bulb,
            hanging * translation({0.0f, 0.1f, 0.0f}) * scaling(glm::vec3(0.06f)));
    glb.add("lamp cord", frustum(0.006f, 0.006f, 0.62f, 12), shade,
            hanging * translation({0.0f, 0.16f, 0.0f}));
}

void addSittingCorner(GlbWriter& glb, int wood, int steel) {
    const SofaMaterials sofa{
        .fabric = glb.addMaterial({.name = "sofa fabric", .baseColor = {0.42f, 0.4f, 0.38f}}),
        .cushion = glb.addMaterial({.name = "cushion fabric", .baseColor = {0.55f, 0.52f, 0.48f}}),
        .wood = wood};
    addSofa(glb, translation({-1.15f, 0.0f, -1.72f}), sofa);
    const int mustard = glb.addMaterial({.name = "mustard cloth", .baseColor = {0.65f, 0.42f, 0.08f}});
    const int pillow = glb.addMesh("pillow", roundedBox({0.2f, 0.2f, 0.07f}, 0.069f, 7), mustard);
    glb.addNode("pillow", pillow,
                translation({-1.85f, 0.71f, -1.66f}) * rotationY(20.0f) * rotationX(-18.0f));
    glb.addNode("pillow", pillow,
                translation({-0.5f, 0.71f, -1.66f}) * rotationY(-15.0f) * rotationX(-20.0f) *
                    rotationZ(12.0f));

    const int rugMaterial = glb.addMaterial(
        {.name = "rug",
         .baseColor = glm::vec3(1.0f),
         .baseColorTexture = glb.addTexture("rug", rug(256, {0.55f, 0.5f, 0.42f}, {0.45f, 0.12f, 0.1f}))});
    // Wide faces of a rounded box carry uv 0..1.
    glb.add("rug", roundedBox({1.25f, 0.008f, 0.85f}, 0.007f, 2), rugMaterial,
            translation({-1.1f, 0.0105f, -0.35f}));
    const glm::mat4 table = translation({-1.1f, 0.019f, -0.4f});
    addCoffeeTable(glb, table, wood, steel);
    const int porcelain =
        glb.addMaterial({.name = "porcelain", .baseColor = {0.78f, 0.78f, 0.75f}, .roughness = 0.12f});
    const std::array fruits{
        glb.addMaterial({.name = "orange", .baseColor = {0.8f, 0.35f, 0.04f}, .roughness = 0.4f}),
        glb.addMaterial({.name = "apple", .baseColor = {0.55f, 0.08f, 0.05f}, .roughness = 0.25f})};
    addFruitBowl(glb, table * translation({0.2f, 0.4005f, 0.02f}), porcelain, fruits);
    const int gold = glb.addMaterial(
        {.name = "gold", .baseColor = {0.95f, 0.79f, 0.42f}, .metallic = 1.0f, .roughness = 0.2f});
    glb.add("gold ball", sphere(0.08f, 48, 24), gold, table * translation({-0.3f, 0.4805f, 0.08f}));
}

void addDiningCorner(GlbWriter& glb, int wood) {
    const int seat = glb.addMaterial({.name = "seat pad", .baseColor = {0.2f, 0.3f, 0.4f}});
    const glm::mat4 middle = translation({1.5f, 0.0025f, -0.55f});
    addRoundTable(glb, middle, wood);
    const int chair = addChairMesh(glb, wood, seat);
    for (float angle : {35.0f, 125.0f, 215.0f, 305.0f})
        glb.addNode("chair", chair, middle * rotationY(angle) * translation({0.0f, 0.0f, -0.62f}));
    const int glaze =
        glb.addMaterial({.name = "blue glaze", .baseColor = {0.08f, 0.2f, 0.45f}, .roughness = 0.1f});
    const std::array<glm::vec2, 11> vase{{{0.0f, 0.0f},
                                          {0.05f, 0.0f},
                                          {0.08f, 0.05f},
                                          {0.09f, 0.11f},
                                          {0.07f, 0.18f},
                                          {0.035f, 0.24f},
                                          {0.05f, 0.3f},
                                          {0.044f, 0.3f},
                                          {0.028f, 0.24f},
                                          {0.06f, 0.1f},
                                          {0.0f, 0.02f}}};
    glb.add("vase", lathe(vase, 48), glaze, middle * translation({0.05f, 0.7505f, 0.05f}));
}

void addBackWall(GlbWriter& glb, int wood) {
    std::vector<int> covers;
    const std::array<glm::vec3, 6> colors{{{0.5f, 0.1f, 0.08f},
                                           {0.1f, 0.2f, 0.4f},
                                           {0.12f, 0.3f, 0.15f},
                                           {0.6f, 0.5f, 0.3f},
                                           {0.7f, 0.68f, 0.6f},
                                           {0.08f, 0.08f, 0.1f}}};
    for (glm::vec3 color : colors)
        covers.push_back(glb.addMaterial({.name = "book cover", .baseColor = color, .roughness = 0.5f}));
    addBookshelf(glb, translation({1.55f, 0.0025f, kRoom.lower.z + 0.18f}), wood, covers);

    const int picture =
        glb.addMaterial({.name = "picture",
                         .baseColor = glm::vec3(1.0f),
                         .roughness = 0.6f,
                         .baseColorTexture = glb.addTexture("landscape", landscape(384, 256))});
    const glm::vec3 centre(-1.15f, 1.65f, kRoom.lower.z + 0.02f);
    glb.add("picture frame", roundedBox({0.64f, 0.44f, 0.018f}, 0.008f, 3), wood, translation(centre));
    glb.add("picture", quad(centre + glm::vec3(-0.6f, -0.4f, 0.019f), {1.2f, 0.0f, 0.0f}, {0.0f, 0.8f, 0.0f}),
            picture);
}

void addWindowSide(GlbWriter& glb, int steel) {
    const int cloth = glb.addMaterial({.name = "curtain cloth", .baseColor = {0.7f, 0.62f, 0.5f}});
    const float x = kRoom.lower.x + 0.12f;
    for (float z : {kWindow.lower.x - 0.15f, kWindow.upper.x + 0.15f})
        addCurtain(glb, translation({x, 0.0f, z}) * rotationY(90.0f), 0.5f, 2.42f, cloth);
    glb.add("curtain rod", frustum(0.012f, 0.012f, 3.0f, 20), steel,
            translation({x, 2.43f, -1.7f}) * rotationX(90.0f));
    const PlantMaterials plant{
        .pot = glb.addMaterial({.name = "terracotta", .baseColor = {0.6f, 0.28f, 0.18f}}),
        .soil = glb.addMaterial({.name = "soil", .baseColor = {0.08f, 0.06f, 0.05f}}),
        .bark = glb.addMaterial({.name = "bark", .baseColor = {0.25f, 0.18f, 0.12f}}),
        .leaf = glb.addMaterial({.name = "leaf", .baseColor = {0.1f, 0.28f, 0.06f}, .roughness = 0.35f})};
    addPlant(glb, translation({-2.35f, 0.0025f, 1.25f}), plant);
}

} // namespace

void writeInterior(const std::filesystem::path& folder) {
    GlbWriter glb;
    const int wood = glb.addMaterial({.name = "oak", .baseColor = {0.45f, 0.28f, 0.15f}, .roughness = 0.45f});
    const int steel = glb.addMaterial(
        {.name = "steel", .baseColor = {0.66f, 0.66f, 0.68f}, .metallic = 1.0f, .roughness = 0.3f});
    addShell(glb);
    addLights(glb);
    addSittingCorner(glb, wood, steel);
    addDiningCorner(glb, wood);
    addBackWall(glb, wood);
    addWindowSide(glb, steel);
    glb.addCamera("camera", {2.75f, 1.6f, 2.3f}, {-0.75f, 0.8f, -0.9f}, 52.0f);
    glb.addCamera("dining corner", {-2.6f, 1.5f, 0.3f}, {1.4f, 0.8f, -0.8f}, 50.0f);
    glb.write(folder / "interior.glb");
}

} // namespace irradia::scenes
