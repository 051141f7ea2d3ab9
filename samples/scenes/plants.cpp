#include "plants.h"

#include "primitives.h"
#include "sheets.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace irradia::scenes {

namespace {

constexpr float kGoldenAngle = 137.508f;
constexpr glm::vec3 kYoung{1.0f, 1.0f, 0.55f}, kOld{0.4f, 0.62f, 0.5f}; // times the leaves' picture
constexpr glm::vec3 kGreenStem{0.16f, 0.3f, 0.07f}, kBark{0.24f, 0.17f, 0.11f};

// A leaf grows from the origin along +z, faces +y, folds along its middle and bends down towards its tip.
Mesh leaf(float length, float width, float droop, uint32_t pieces) {
    const auto surface = [=](float u, float v) {
        const float across = 2.0f * u - 1.0f;
        const float fold = 0.3f * std::abs(across) * width * 0.5f;
        return glm::vec3(-0.5f * width * across, fold - droop * length * v * v, length * v);
    };
    return openSheet(surface, 2, pieces);
}

void addLeaf(Mesh& leaves, Mesh shape, float age, const glm::mat4& place) {
    leaves.append(shape.paint(glm::mix(kYoung, kOld, age)), place);
}

void addStem(Greenery& plants, glm::vec3 from, glm::vec3 to, float radius, glm::vec3 color,
             const glm::mat4& place) {
    Mesh stem = frustum(radius, 0.7f * radius, glm::distance(from, to), radius < 0.005f ? 4 : 6);
    plants.stems.append(stem.paint(color), place * standing(from, to));
}

// A direction `rise` degrees above the horizon, turned about y.
glm::vec3 direction(float turn, float rise) {
    const float t = glm::radians(turn), r = glm::radians(rise);
    return {std::sin(t) * std::cos(r), std::sin(r), std::cos(t) * std::cos(r)};
}

glm::mat4 pointing(glm::vec3 at, float turn, float rise, float roll = 0.0f) {
    return translation(at) * rotationY(turn) * rotationX(-rise) * rotationZ(roll);
}

void addBlossom(Greenery& plants, const glm::mat4& place, glm::vec3 color, Random& random) {
    for (int i = 0; i < 10; i++) {
        Mesh floret = icosphere(0);
        const glm::vec3 at = 0.028f * direction(random.between(0.0f, 360.0f), random.between(-20.0f, 90.0f));
        floret.paint(color * random.between(0.75f, 1.0f));
        plants.fruits.append(floret, place * translation(at) * scaling(glm::vec3(0.015f)));
    }
}

} // namespace

void addBush(Greenery& plants, const glm::mat4& place, float height, glm::vec3 blossom, uint32_t seed) {
    Random random(seed);
    for (int i = 0; i < 9; i++) {
        const float turn = kGoldenAngle * static_cast<float>(i);
        const float length = height * random.between(0.7f, 1.0f);
        const glm::vec3 top = length * direction(turn, 86.0f - 5.5f * static_cast<float>(i));
        addStem(plants, glm::vec3(0.0f), top, 0.007f, kGreenStem, place);
        for (int j = 0; j < 9; j++) {
            const float t = 0.3f + 0.085f * static_cast<float>(j);
            const float size = height * random.between(0.2f, 0.34f);
            addLeaf(plants.toothed, leaf(size, 0.75f * size, 0.3f, 2),
                    random.between(0.2f, 1.0f) * (1.2f - t),
                    place * pointing(t * top, turn + kGoldenAngle * static_cast<float>(j),
                                     random.between(-15.0f, 45.0f), random.between(-25.0f, 25.0f)));
        }
        if (i % 3 == 0) addBlossom(plants, place * translation(1.04f * top), blossom, random);
    }
}

void addSlitLeaved(Greenery& plants, const glm::mat4& place, float height, uint32_t seed) {
    Random random(seed);
    const int leaves = 15;
    for (int i = 0; i < leaves; i++) {
        const float age = static_cast<float>(leaves - 1 - i) / static_cast<float>(leaves - 1);
        const float turn = kGoldenAngle * static_cast<float>(i) + random.between(-15.0f, 15.0f);
        const glm::vec3 top = height * (1.0f - 0.3f * age) * direction(turn, 84.0f - 40.0f * age);
        addStem(plants, glm::vec3(0.0f), top, 0.009f, kGreenStem, place);
        const float size = height * random.between(0.3f, 0.4f);
        addLeaf(plants.slit, leaf(size, 0.85f * size, 0.35f, 5), age,
                place * pointing(top, turn + random.between(-20.0f, 20.0f), random.between(-25.0f, 20.0f),
                                 random.between(-15.0f, 15.0f)));
    }
}

void addLemonTree(Greenery& plants, const glm::mat4& place, float height, uint32_t seed) {
    Random random(seed);
    const float radius = 0.27f * height;
    const glm::vec3 fork(0.0f, 0.55f * height, 0.0f), middle(0.0f, 0.76f * height, 0.0f);
    addStem(plants, glm::vec3(0.0f), fork, 0.02f, kBark, place);
    const Mesh fruit = lemon();
    const int twigs = 56;
    for (int i = 0; i < twigs; i++) {
        const float turn = kGoldenAngle * static_cast<float>(i);
        const float rise = glm::degrees(std::asin(1.0f - 1.7f * static_cast<float>(i) / twigs));
        const glm::vec3 top = middle + radius * random.between(0.75f, 1.0f) * direction(turn, rise);
        addStem(plants, fork, top, 0.006f, kBark, place);
        for (int j = 0; j < 6; j++) {
            const glm::vec3 at = glm::mix(fork, top, 0.6f + 0.08f * static_cast<float>(j));
            addLeaf(plants.toothed, leaf(random.between(0.1f, 0.15f), 0.06f, 0.25f, 2),
                    random.between(0.3f, 1.0f),
                    place * pointing(at, turn + random.between(-80.0f, 80.0f),
                                     rise * 0.5f + random.between(-30.0f, 30.0f),
                                     random.between(-30.0f, 30.0f)));
        }
        if (i % 5 == 2)
            plants.fruits.append(fruit, place * translation(top - glm::vec3(0.0f, 0.06f, 0.0f)) *
                                            rotationZ(random.between(-20.0f, 20.0f)));
    }
}

void addClimber(Greenery& plants, const glm::mat4& place, glm::vec2 size, uint32_t seed) {
    Random random(seed);
    const int shoots = 7;
    for (int i = 0; i < shoots; i++) {
        glm::vec3 at(size.x * (static_cast<float>(i) + 0.5f) / shoots, 0.0f, 0.02f);
        const float top = size.y * random.between(0.65f, 1.0f);
        while (at.y < top) {
            const glm::vec3 next =
                at + glm::vec3(random.between(-0.05f, 0.05f), random.between(0.06f, 0.1f), 0.0f);
            addStem(plants, at, next, 0.004f, kBark, place);
            for (float side : {-1.0f, 1.0f}) {
                const float length = random.between(0.09f, 0.17f);
                addLeaf(plants.toothed, leaf(length, 0.8f * length, 0.3f, 2),
                        random.between(0.0f, 0.9f) * (1.1f - at.y / size.y),
                        place * translation(at) * rotationZ(side * random.between(-20.0f, 110.0f)) *
                            rotationX(random.between(25.0f, 75.0f)));
            }
            at = next;
        }
    }
}

void addTrailing(Greenery& plants, const glm::mat4& place, float length, uint32_t seed) {
    Random random(seed);
    for (int i = 0; i < 14; i++) {
        const float turn = kGoldenAngle * static_cast<float>(i);
        glm::vec3 at = 0.13f * direction(turn, 0.0f);
        const float bottom = -length * random.between(0.35f, 1.0f);
        for (int j = 0; at.y > bottom; j++) {
            const glm::vec3 next =
                at + glm::vec3(random.between(-0.02f, 0.02f), -0.05f, random.between(-0.02f, 0.02f));
            addStem(plants, next, at, 0.003f, kGreenStem, place);
            const float size = random.between(0.05f, 0.09f);
            addLeaf(plants.toothed, leaf(size, 0.8f * size, 0.3f, 2), random.between(0.0f, 0.7f),
                    place *
                        pointing(at, turn + (j % 2 == 0 ? 70.0f : -70.0f), random.between(-50.0f, 10.0f)));
            at = next;
        }
    }
}

Mesh lemon() {
    Mesh mesh;
    mesh.append(sphere(0.034f, 14, 9), scaling({1.0f, 1.35f, 1.0f}));
    for (glm::vec3 p : mesh.positions)
        mesh.colors.push_back(glm::mix(glm::vec3(0.85f, 0.62f, 0.05f), glm::vec3(0.35f, 0.45f, 0.05f),
                                       glm::smoothstep(0.0f, 0.045f, p.y)));
    return mesh;
}

} // namespace irradia::scenes
