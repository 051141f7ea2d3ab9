// A greenhouse in the sun, which shines through its panes and a net onto the floor and a wall of bricks; in
// two pixels of three most light has come by those. Glass clear, tinted, frosted and solid; leaves with an
// outline in alpha. The camera file beside the scene brings an even sky.
#include "camera_file.h"
#include "garden_things.h"
#include "glasshouse.h"
#include "plants.h"
#include "primitives.h"
#include "scenes.h"
#include "sheets.h"
#include "textures.h"
#include "tile_material.h"

#include <array>
#include <cmath>

namespace irradia::scenes {

namespace {

constexpr LeanTo kHouse{{-1.7f, 0.0f, -3.4f}, {1.7f, 3.1f, 2.8f}, 0.5f, 1.9f};
constexpr View kView{{0.35f, 1.45f, 2.5f}, {-0.15f, 0.84f, -1.2f}, 56.0f};
constexpr glm::vec3 kSunlight{-0.66f, 0.56f, -0.68f}; // the sun's direction
constexpr glm::vec3 kSunIrradiance{10.5f, 9.3f, 7.5f}, kSky{0.25f, 0.35f, 0.5f};
constexpr float kBenchHeight = 0.72f;

int addPane(GlbWriter& glb, const char* name, glm::vec3 color, float roughness = 0.0f) {
    return glb.addMaterial({.name = name,
                            .baseColor = color,
                            .roughness = roughness,
                            .doubleSided = true,
                            .transmission = 1.0f});
}

void addHouse(GlbWriter& glb) {
    const LeanToMaterials materials{
        .frame =
            glb.addMaterial({.name = "white paint", .baseColor = {0.74f, 0.77f, 0.72f}, .roughness = 0.4f}),
        .plinth = glb.addMaterial({.name = "stone", .baseColor = {0.62f, 0.58f, 0.52f}}),
        .wall = glb.addMaterial({.name = "plaster", .baseColor = {0.8f, 0.77f, 0.7f}}),
        .bricks = glb.addMaterial({.name = "bricks",
                                   .baseColor = glm::vec3(1.0f),
                                   .baseColorTexture = glb.addTexture(
                                       "bricks", bricks(512, {0.68f, 0.63f, 0.55f}, {0.52f, 0.28f, 0.18f}))}),
        .clear = addPane(glb, "clear glass", glm::vec3(0.95f)),
        .green = addPane(glb, "green glass", {0.35f, 0.8f, 0.4f}),
        .amber = addPane(glb, "amber glass", {0.93f, 0.58f, 0.16f}),
        .frosted = addPane(glb, "frosted glass", glm::vec3(0.92f), 0.4f)};
    addLeanTo(glb, kHouse, materials);
}

void addTiledFloor(GlbWriter& glb) {
    const int floor = addTiles(glb, {0.74f, 0.67f, 0.55f}, {0.52f, 0.29f, 0.19f});
    const glm::vec3 size = kHouse.upper - kHouse.lower;
    Mesh mesh = quad({kHouse.lower.x, 0.002f, kHouse.upper.z + 0.05f}, {size.x + 0.05f, 0.0f, 0.0f},
                     {0.0f, 0.0f, -size.z - 0.1f}, {3.0f, 5.5f});
    mesh.computeTangents();
    glb.add("tiled floor", mesh, floor);
}

// A lawn around the house and a hedge beyond it, in the colours of their vertices.
void addGarden(GlbWriter& glb) {
    const int grown = glb.addMaterial({.name = "garden", .baseColor = glm::vec3(1.0f), .specular = 0.0f});
    const auto bumps = [](float x, float y) {
        return std::sin(2.1f * x + 1.3f * std::sin(1.7f * y)) * std::sin(2.7f * y + std::sin(1.1f * x)) +
               0.5f * std::sin(6.3f * x + 2.0f * y) * std::sin(5.1f * y - x);
    };
    const auto grow = [&](const Surface& surface, uint32_t nu, uint32_t nv, glm::vec3 dark, glm::vec3 light) {
        Mesh mesh = openSheet(surface, nu, nv);
        for (glm::vec3 p : mesh.positions)
            mesh.colors.push_back(glm::mix(dark, light, 0.5f + 0.33f * bumps(p.x + p.z, p.y - p.z)));
        return mesh;
    };
    const auto ground = [](float u, float v) {
        return glm::vec3(40.0f * u - 20.0f, -0.12f, 20.0f - 40.0f * v);
    };
    Mesh garden = grow(ground, 24, 24, {0.1f, 0.2f, 0.04f}, {0.2f, 0.3f, 0.08f});
    const auto hedge = [&](float u, float v) {
        const float x = 16.0f * u - 8.0f, y = 1.9f * v;
        return glm::vec3(x, y - 0.1f, 0.12f * bumps(0.7f * x, 1.1f * y) + 0.2f - v * v * 0.5f);
    };
    const Mesh green = grow(hedge, 64, 10, {0.05f, 0.13f, 0.03f}, {0.15f, 0.27f, 0.06f});
    garden.append(green, translation({0.0f, 0.0f, -9.0f}));
    garden.append(green, translation({-8.0f, 0.0f, -1.0f}) * rotationY(90.0f));
    glb.add("garden", garden, grown);
}

// Under the roof's upper part, sagging between its bars.
void addNet(GlbWriter& glb) {
    const int cloth =
        glb.addMaterial({.name = "shade net",
                         .baseColor = glm::vec3(1.0f),
                         .specular = 0.0f,
                         .baseColorTexture = glb.addTexture("net", net(128, {0.7f, 0.72f, 0.62f})),
                         .alphaMode = "BLEND",
                         .doubleSided = true});
    const auto surface = [](float u, float v) {
        const float x = glm::mix(-0.2f, kHouse.upper.x - 0.03f, u), z = glm::mix(2.7f, -3.3f, v);
        const float sag = 0.03f + 0.05f * std::abs(std::sin(15.7f * v)) + 0.06f * std::sin(3.14159f * u);
        return glm::vec3(x, kHouse.roof(x) - 0.05f - sag, z);
    };
    Mesh mesh = openSheet(surface, 8, 60);
    for (glm::vec2& uv : mesh.uvs) uv *= glm::vec2(6.0f, 20.0f);
    glb.add("shade net", mesh, cloth);
}

void addStillLife(GlbWriter& glb, Greenery& plants, int wood, const glm::mat4& place) {
    const float top = addStool(glb, place, wood);
    const int glass = glb.addMaterial({.name = "carafe glass",
                                       .baseColor = glm::vec3(1.0f),
                                       .roughness = 0.0f,
                                       .transmission = 1.0f,
                                       .thickness = 0.006f,
                                       .attenuationDistance = 0.03f,
                                       .attenuationColor = {0.45f, 0.8f, 0.7f}});
    glb.add("carafe", carafe(), glass, place * translation({-0.03f, top + 0.001f, -0.03f}));
    plants.fruits.append(lemon(), place * translation({0.09f, top + 0.034f, 0.03f}) * rotationZ(85.0f));
    plants.fruits.append(lemon(), place * translation({0.03f, top + 0.034f, 0.11f}) * rotationY(70.0f) *
                                      rotationZ(95.0f));
}

void addPlants(GlbWriter& glb, Greenery& plants) {
    Pots pots(glb);
    const std::array<glm::vec3, 3> blossoms{
        {{0.75f, 0.08f, 0.1f}, {0.85f, 0.35f, 0.5f}, {0.85f, 0.8f, 0.7f}}};
    Random random(3);
    for (uint32_t i = 0; i < 7; i++) { // along the bench
        const glm::vec3 at(-1.3f + random.between(-0.12f, 0.14f), kBenchHeight,
                           0.6f - 0.57f * static_cast<float>(i));
        const float scale = random.between(0.6f, 0.85f);
        const glm::mat4 place = pots.place(at, scale, random.between(0.0f, 360.0f));
        if (i % 3 == 2)
            addSlitLeaved(plants, place, random.between(0.5f, 0.65f), i);
        else
            addBush(plants, place, random.between(0.34f, 0.5f), blossoms[i % 3], i);
    }
    addLemonTree(plants, pots.place({1.05f, 0.0025f, -1.55f}, 1.35f, 0.0f), 1.5f, 21);
    addSlitLeaved(plants, pots.place({0.55f, 0.0025f, -2.85f}, 1.3f, 0.0f), 1.35f, 22);
    addSlitLeaved(plants, pots.place({-0.45f, 0.0025f, -2.95f}, 1.0f, 0.0f), 0.9f, 23);
    addSlitLeaved(plants, pots.place({-1.3f, 0.0025f, 1.3f}, 1.3f, 0.0f), 1.25f, 26);
    addBush(plants, pots.place({1.35f, 0.0025f, -0.75f}, 1.0f, 0.0f), 0.55f, blossoms[1], 24);
    addClimber(plants, translation({kHouse.upper.x - 0.02f, 0.0f, -0.75f}) * rotationY(-90.0f), {1.5f, 2.2f},
               25);
    for (float z : {-0.2f, -1.9f}) {
        const float x = z > -1.0f ? -0.75f : -0.25f;
        const glm::mat4 basket = pots.hang({x, 1.5f, z}, 0.85f, kHouse.roof(x));
        addBush(plants, basket, 0.28f, blossoms[0], 31);
        addTrailing(plants, basket, 0.6f, 32);
    }
}

void addGreenery(GlbWriter& glb, const Greenery& plants) {
    const auto leaf = [&](const char* name, const Rgba8Image& picture) {
        return glb.addMaterial({.name = name,
                                .baseColor = glm::vec3(1.0f),
                                .roughness = 0.45f,
                                .baseColorTexture = glb.addTexture(name, picture),
                                .alphaMode = "MASK",
                                .doubleSided = true});
    };
    const glm::vec3 blade(0.26f, 0.46f, 0.1f), vein(0.5f, 0.62f, 0.25f);
    glb.add("toothed leaves", plants.toothed, leaf("toothed leaf", toothedLeaf(128, blade, vein)));
    glb.add("slit leaves", plants.slit, leaf("slit leaf", slitLeaf(192, blade, vein)));
    glb.add("stems", plants.stems, glb.addMaterial({.name = "stems", .baseColor = glm::vec3(1.0f)}));
    glb.add("fruits", plants.fruits,
            glb.addMaterial({.name = "fruits", .baseColor = glm::vec3(1.0f), .roughness = 0.5f}));
}

} // namespace

void writeGreenhouse(const std::filesystem::path& folder) {
    GlbWriter glb;
    const int wood = glb.addMaterial(
        {.name = "oiled wood",
         .baseColor = glm::vec3(1.0f),
         .roughness = 0.55f,
         .baseColorTexture = glb.addTexture("boards", floorBoards(256, {0.55f, 0.38f, 0.23f}))});
    const int zinc = glb.addMaterial(
        {.name = "zinc", .baseColor = {0.62f, 0.64f, 0.66f}, .metallic = 1.0f, .roughness = 0.35f});
    addHouse(glb);
    addTiledFloor(glb);
    addGarden(glb);
    addNet(glb);
    addBench(glb, translation({-1.6f, 0.0f, -3.2f}), {0.72f, kBenchHeight, 4.1f}, wood);
    Greenery plants;
    addStillLife(glb, plants, wood, translation({0.72f, 0.0025f, 0.75f}));
    addPlants(glb, plants);
    addGreenery(glb, plants);
    addWateringCan(glb, translation({-0.3f, 0.0025f, 0.25f}) * rotationY(-30.0f), zinc);
    glb.addSun("sun", -kSunlight, kSunIrradiance);
    glb.addCamera("camera", kView.eye, kView.target, kView.verticalFovDegrees);
    glb.write(folder / "greenhouse.glb");
    writeCameraFile(folder / "greenhouse.json", kView, kSky);
}

} // namespace irradia::scenes
