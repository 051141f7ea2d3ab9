#include "furniture.h"

#include "primitives.h"
#include "random.h"
#include "sheets.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace irradia::scenes {

void addSofa(GlbWriter& glb, const glm::mat4& place, SofaMaterials m) {
    glb.add("sofa base", roundedBox({0.95f, 0.13f, 0.44f}, 0.04f, 5), m.fabric,
            place * translation({0.0f, 0.23f, 0.0f}));
    glb.add("sofa back", roundedBox({0.95f, 0.3f, 0.1f}, 0.08f, 5), m.fabric,
            place * translation({0.0f, 0.6f, -0.37f}) * rotationX(-6.0f));
    const int arm = glb.addMesh("sofa arm", roundedBox({0.1f, 0.28f, 0.47f}, 0.09f, 7), m.fabric);
    const int seat = glb.addMesh("seat cushion", roundedBox({0.308f, 0.085f, 0.34f}, 0.08f, 7), m.cushion);
    const int back = glb.addMesh("back cushion", roundedBox({0.3f, 0.22f, 0.09f}, 0.085f, 7), m.cushion);
    const int foot = glb.addMesh("sofa foot", frustum(0.02f, 0.03f, 0.12f, 20), m.wood);
    for (float side : {-1.0f, 1.0f}) {
        glb.addNode("sofa arm", arm, place * translation({side * 1.02f, 0.38f, 0.0f}));
        for (float z : {-0.36f, 0.36f})
            glb.addNode("sofa foot", foot, place * translation({side * 0.85f, 0.0f, z}));
    }
    for (float third : {-1.0f, 0.0f, 1.0f}) {
        glb.addNode("seat cushion", seat, place * translation({third * 0.617f, 0.435f, 0.09f}));
        glb.addNode("back cushion", back,
                    place * translation({third * 0.612f, 0.73f, -0.2f}) * rotationX(-12.0f));
    }
}

void addRoundTable(GlbWriter& glb, const glm::mat4& place, int wood) {
    const std::array<glm::vec2, 15> outline{{{0.0f, 0.0f},
                                             {0.3f, 0.0f},
                                             {0.31f, 0.02f},
                                             {0.28f, 0.04f},
                                             {0.1f, 0.07f},
                                             {0.06f, 0.12f},
                                             {0.05f, 0.3f},
                                             {0.07f, 0.42f},
                                             {0.05f, 0.55f},
                                             {0.09f, 0.7f},
                                             {0.53f, 0.715f},
                                             {0.55f, 0.725f},
                                             {0.55f, 0.74f},
                                             {0.54f, 0.75f},
                                             {0.0f, 0.75f}}};
    glb.add("round table", lathe(outline, 64), wood, place);
}

int addChairMesh(GlbWriter& glb, int wood, int fabric) {
    Mesh frame;
    const Mesh leg = frustum(0.016f, 0.022f, 0.44f, 20);
    const Mesh post = frustum(0.018f, 0.014f, 0.5f, 20);
    for (float x : {-0.18f, 0.18f}) {
        for (float z : {-0.18f, 0.18f}) frame.append(leg, translation({x, 0.0f, z}));
        frame.append(post, translation({x, 0.44f, -0.19f}) * rotationX(-8.0f));
    }
    const glm::mat4 leaning = translation({0.0f, 0.84f, -0.245f}) * rotationX(-8.0f);
    frame.append(roundedBox({0.2f, 0.1f, 0.012f}, 0.01f, 4), leaning);
    frame.append(roundedBox({0.22f, 0.015f, 0.22f}, 0.012f, 3), translation({0.0f, 0.45f, 0.0f}));
    Mesh pad;
    pad.append(roundedBox({0.2f, 0.025f, 0.2f}, 0.024f, 4), translation({0.0f, 0.486f, 0.0f}));
    const std::array<GlbWriter::Part, 2> parts{{{&frame, wood}, {&pad, fabric}}};
    return glb.addMesh("chair", parts);
}

void addCoffeeTable(GlbWriter& glb, const glm::mat4& place, int wood, int metal) {
    glb.add("coffee table top", roundedBox({0.65f, 0.02f, 0.35f}, 0.015f, 4), wood,
            place * translation({0.0f, 0.38f, 0.0f}));
    const int leg = glb.addMesh("coffee table leg", frustum(0.014f, 0.02f, 0.365f, 20), metal);
    for (float x : {-0.56f, 0.56f})
        for (float z : {-0.27f, 0.27f})
            glb.addNode("coffee table leg", leg, place * translation({x, 0.0f, z}));
}

void addBookshelf(GlbWriter& glb, const glm::mat4& place, int wood, std::span<const int> bookMaterials) {
    const float halfWidth = 0.8f, depth = 0.3f, board = 0.02f, storey = 0.41f;
    const Mesh plank = roundedBox({halfWidth - 0.005f, 0.5f * board, 0.5f * depth - 0.005f}, 0.004f, 1);
    const Mesh side = roundedBox({0.5f * board, 1.05f, 0.5f * depth}, 0.004f, 1);
    Mesh shelf;
    for (float x : {-halfWidth, halfWidth}) shelf.append(side, translation({x, 1.05f, 0.0f}));
    for (int i = 0; i < 6; i++)
        shelf.append(plank, translation({0.0f, 0.03f + storey * static_cast<float>(i), 0.0f}));
    shelf.append(box({-halfWidth, 0.02f, -0.5f * depth - 0.01f}, {halfWidth, 2.09f, -0.5f * depth + 0.008f}));
    glb.add("bookshelf", shelf, wood, place);

    std::vector<Mesh> books(bookMaterials.size());
    Random random(7);
    for (int row = 0; row < 5; row++) {
        const float floor = 0.0405f + storey * static_cast<float>(row);
        const float end = halfWidth - random.between(0.05f, 0.5f);
        for (float x = -halfWidth + 0.025f; x < end;) {
            const glm::vec3 size(random.between(0.022f, 0.065f), random.between(0.22f, 0.34f),
                                 random.between(0.16f, 0.22f));
            const auto which = static_cast<size_t>(random.between(0.0f, static_cast<float>(books.size())));
            const glm::vec3 centre(x + 0.5f * size.x, floor + 0.5f * size.y, 0.12f - 0.5f * size.z);
            books[which].append(roundedBox(0.5f * size, 0.004f, 1), translation(centre));
            x += size.x + 0.002f;
        }
    }
    for (size_t i = 0; i < books.size(); i++) glb.add("books", books[i], bookMaterials[i], place);
}

void addPlant(GlbWriter& glb, const glm::mat4& place, PlantMaterials m) {
    const std::array<glm::vec2, 8> pot{{{0.0f, 0.0f},
                                        {0.13f, 0.0f},
                                        {0.18f, 0.3f},
                                        {0.2f, 0.32f},
                                        {0.2f, 0.36f},
                                        {0.17f, 0.36f},
                                        {0.15f, 0.28f},
                                        {0.0f, 0.27f}}};
    glb.add("pot", lathe(pot, 48), m.pot, place);
    glb.add("soil", frustum(0.14f, 0.155f, 0.05f, 32), m.soil, place * translation({0.0f, 0.26f, 0.0f}));
    glb.add("trunk", frustum(0.02f, 0.008f, 1.15f, 16), m.bark, place * translation({0.0f, 0.3f, 0.0f}));

    // A leaf grows along +z, arching down.
    const auto surface = [](float u, float v) {
        const float halfWidth = 0.055f * std::sin(glm::pi<float>() * (0.04f + 0.92f * v));
        const float across = 2.0f * u - 1.0f;
        return glm::vec3(-across * halfWidth, 0.3f * v - 0.42f * v * v + 0.2f * halfWidth * across * across,
                         0.42f * v);
    };
    const int leaf = glb.addMesh("leaf", sheet(surface, 4, 10, 0.0025f), m.leaf);
    Random random(11);
    const int leaves = 100;
    for (int i = 0; i < leaves; i++) {
        const float t = static_cast<float>(i) / static_cast<float>(leaves);
        const float goldenAngle = 137.508f * static_cast<float>(i);
        const float rise = glm::mix(-10.0f, 65.0f, t) + random.between(-12.0f, 12.0f);
        glb.addNode("leaf", leaf,
                    place * translation({0.0f, 0.6f + 0.85f * t, 0.0f}) * rotationY(goldenAngle) *
                        rotationX(-rise) * scaling(glm::vec3(random.between(0.75f, 1.1f))));
    }
}

void addCurtain(GlbWriter& glb, const glm::mat4& place, float width, float top, int cloth) {
    const float bottom = 0.02f;
    const auto surface = [&](float u, float v) {
        const float fold = std::sin(glm::two_pi<float>() * 5.0f * u + 0.6f * std::sin(3.0f * v));
        return glm::vec3(width * (u - 0.5f), glm::mix(bottom, top, v), (0.04f - 0.015f * v) * fold);
    };
    glb.add("curtain", sheet(surface, 80, 10, 0.003f), cloth, place);
}

void addFruitBowl(GlbWriter& glb, const glm::mat4& place, int bowl, std::span<const int> fruitMaterials) {
    const std::array<glm::vec2, 13> outline{{{0.0f, 0.0f},
                                             {0.06f, 0.0f},
                                             {0.06f, 0.012f},
                                             {0.1f, 0.025f},
                                             {0.14f, 0.05f},
                                             {0.165f, 0.085f},
                                             {0.17f, 0.1f},
                                             {0.162f, 0.1f},
                                             {0.155f, 0.085f},
                                             {0.13f, 0.055f},
                                             {0.095f, 0.033f},
                                             {0.05f, 0.022f},
                                             {0.0f, 0.02f}}};
    glb.add("bowl", lathe(outline, 48), bowl, place);
    std::vector<int> fruits;
    for (int material : fruitMaterials)
        fruits.push_back(glb.addMesh("fruit", sphere(0.042f, 32, 16), material));
    for (size_t i = 0; i < 6; i++) {
        const bool onTop = i == 5;
        const float angle = 72.0f * static_cast<float>(i);
        glb.addNode("fruit", fruits[i % fruits.size()],
                    place * rotationY(angle) *
                        translation(onTop ? glm::vec3(0.0f, 0.135f, 0.0f) : glm::vec3(0.0f, 0.085f, 0.077f)));
    }
}

} // namespace irradia::scenes
