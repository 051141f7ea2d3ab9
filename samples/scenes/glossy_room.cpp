// Metals of roughness 0.05 to 0.5 over a tiled floor, lit by a sky through one window. glTF has no
// environment: the camera file beside the scene names the sky's picture.
#include "camera_file.h"
#include "room.h"
#include "scenes.h"
#include "textures.h"
#include "tile_material.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace irradia::scenes {

namespace {

constexpr Room kRoom{{-2.5f, 0.0f, -2.2f}, {2.5f, 2.8f, 2.4f}};
constexpr Rectangle kWindow{{-1.5f, 0.7f}, {1.3f, 2.4f}}; // (z, y) in the wall at lower.x
constexpr glm::vec3 kEye{0.9f, 1.5f, 2.25f}, kTarget{-0.5f, 0.6f, -0.8f};
constexpr float kFovDegrees = 58.0f;

// Radiance from a direction: a gradient, a ground, and a sun of 6 degrees with a soft edge, its radiance
// moderate so that pictures converge.
glm::vec3 skyRadiance(glm::vec3 direction) {
    const glm::vec3 toSun = glm::normalize(glm::vec3(-0.8f, 0.55f, 0.12f));
    const float degrees = glm::degrees(std::acos(glm::clamp(glm::dot(direction, toSun), -1.0f, 1.0f)));
    const glm::vec3 sun = glm::vec3(160.0f, 135.0f, 100.0f) * (1.0f - glm::smoothstep(4.0f, 8.0f, degrees));
    const glm::vec3 halo = glm::vec3(2.0f, 1.6f, 1.1f) * std::exp(-degrees / 20.0f);
    const glm::vec3 sky = glm::mix(glm::vec3(3.2f, 3.6f, 4.2f), glm::vec3(1.2f, 2.0f, 3.6f),
                                   std::sqrt(glm::clamp(direction.y, 0.0f, 1.0f)));
    const glm::vec3 ground(0.7f, 0.65f, 0.5f);
    return glm::mix(ground, sky + sun + halo, glm::smoothstep(-0.05f, 0.02f, direction.y));
}

void writeSky(const std::filesystem::path& file) {
    LayeredImage image;
    image.width = 256;
    image.height = 128;
    std::vector<glm::vec3> pixels;
    for (int y = 0; y < image.height; y++) {
        const float theta =
            glm::pi<float>() * (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height);
        for (int x = 0; x < image.width; x++) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(image.width);
            const float phi = glm::two_pi<float>() * (u - 0.5f); // atan2(z, x)
            pixels.push_back(skyRadiance(
                {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)}));
        }
    }
    image.setRgb("", pixels);
    writeExr(file, image);
}

void addShell(GlbWriter& glb) {
    const int wall = glb.addMaterial({.name = "wall", .baseColor = {0.75f, 0.73f, 0.7f}});
    const int backWall =
        glb.addMaterial({.name = "back wall", .baseColor = {0.3f, 0.42f, 0.45f}, .roughness = 0.6f});
    const int frame = glb.addMaterial({.name = "frame", .baseColor = glm::vec3(0.8f), .roughness = 0.4f});
    glb.add("slab", kRoom.floor(), wall);
    glb.add("ceiling", kRoom.ceiling(), wall);
    glb.add("wall +x", kRoom.wallPositiveX(), wall);
    glb.add("wall -z", kRoom.wallNegativeZ(), backWall);
    glb.add("wall +z", kRoom.wallPositiveZ(), wall);
    glb.add("window wall", kRoom.wallNegativeXWithOpening(kWindow), wall);
    const float x = kRoom.lower.x - 0.12f;
    const float z = 0.5f * (kWindow.lower.x + kWindow.upper.x),
                y = 0.5f * (kWindow.lower.y + kWindow.upper.y);
    glb.add("mullion",
            box({x, kWindow.lower.y - 0.05f, z - 0.03f}, {x + 0.05f, kWindow.upper.y + 0.05f, z + 0.03f}),
            frame);
    glb.add("transom",
            box({x + 0.005f, y - 0.03f, kWindow.lower.x - 0.05f},
                {x + 0.045f, y + 0.03f, kWindow.upper.x + 0.05f}),
            frame);
}

void addTiledFloor(GlbWriter& glb) {
    const int floor = addTiles(glb, {0.72f, 0.66f, 0.55f}, {0.2f, 0.22f, 0.26f});
    const glm::vec3 size = kRoom.upper - kRoom.lower;
    // Just above the slab, reaching into the walls.
    Mesh mesh = quad({kRoom.lower.x - 0.05f, 0.002f, kRoom.upper.z + 0.05f}, {size.x + 0.1f, 0.0f, 0.0f},
                     {0.0f, 0.0f, -size.z - 0.1f}, {2.5f, 2.3f});
    mesh.computeTangents();
    glb.add("tiled floor", mesh, floor);
}

void addMetals(GlbWriter& glb) {
    const std::array<float, 5> roughness{0.05f, 0.1f, 0.2f, 0.35f, 0.5f};
    const std::array<glm::vec3, 5> colors{{{0.95f, 0.93f, 0.88f},   // silver
                                           {0.95f, 0.79f, 0.42f},   // gold
                                           {0.93f, 0.64f, 0.54f},   // copper
                                           {0.66f, 0.66f, 0.68f},   // steel
                                           {0.91f, 0.92f, 0.92f}}}; // aluminium
    const Mesh ball = sphere(0.27f, 64, 32);
    const Mesh plate = roundedBox({0.34f, 0.5f, 0.015f}, 0.01f, 3);
    for (size_t i = 0; i < roughness.size(); i++) {
        const int metal = glb.addMaterial({.name = fmt::format("metal {}", roughness[i]),
                                           .baseColor = colors[i],
                                           .metallic = 1.0f,
                                           .roughness = roughness[i]});
        const float x = -1.7f + 0.7f * static_cast<float>(i);
        const glm::mat4 leaning = translation({x, 0.492f, -2.04f}) * rotationX(-15.0f);
        glb.add(fmt::format("ball {}", i), ball, metal, translation({x, 0.272f, -0.6f}));
        glb.add(fmt::format("plate {}", i), plate, metal, leaning);
    }
}

void addPaintedThings(GlbWriter& glb) {
    const int lacquer =
        glb.addMaterial({.name = "red lacquer", .baseColor = {0.6f, 0.06f, 0.05f}, .roughness = 0.12f});
    const int chalk = glb.addMaterial({.name = "chalk", .baseColor = glm::vec3(0.8f)});
    glb.add("lacquered ball", sphere(0.2f, 48, 24), lacquer, translation({-1.25f, 0.202f, 0.85f}));
    glb.add("chalk block", roundedBox({0.18f, 0.25f, 0.18f}, 0.03f, 4), chalk,
            translation({-0.35f, 0.2525f, 0.95f}) * rotationY(30.0f));
}

} // namespace

void writeGlossyRoom(const std::filesystem::path& folder) {
    GlbWriter glb;
    addShell(glb);
    addTiledFloor(glb);
    addMetals(glb);
    addPaintedThings(glb);
    glb.addCamera("camera", kEye, kTarget, kFovDegrees);
    glb.write(folder / "glossy-room.glb");
    writeSky(folder / "glossy-room-sky.exr");
    writeCameraFile(folder / "glossy-room.json", {kEye, kTarget, kFovDegrees}, "glossy-room-sky.exr");
}

} // namespace irradia::scenes
