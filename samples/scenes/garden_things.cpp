#include "garden_things.h"

#include "primitives.h"

#include <array>
#include <cmath>

namespace irradia::scenes {

void addBench(GlbWriter& glb, const glm::mat4& place, glm::vec3 size, int wood) {
    const float slat = 0.03f, post = 0.03f; // thickness, half width
    const int slats = 6;
    Mesh bench;
    for (int i = 0; i < slats; i++) {
        const float x = (size.x - 0.1f) * static_cast<float>(i) / (slats - 1);
        bench.append(box({x, size.y - slat, 0.0f}, {x + 0.1f, size.y, size.z}));
    }
    for (float z : {0.1f, 0.5f * size.z, size.z - 0.1f}) {
        bench.append(
            box({0.001f, size.y - slat - 0.06f, z - 0.03f}, {size.x - 0.001f, size.y - slat, z + 0.03f}));
        for (float x : {0.035f, size.x - 0.035f})
            bench.append(box({x - post, 0.0f, z - 0.028f}, {x + post, size.y - 0.04f, z + 0.028f}));
    }
    glb.add("bench", bench, wood, place);
}

float addStool(GlbWriter& glb, const glm::mat4& place, int wood) {
    const float height = 0.52f;
    const std::array<glm::vec2, 6> seat{{{0.0f, height - 0.035f},
                                         {0.19f, height - 0.035f},
                                         {0.205f, height - 0.025f},
                                         {0.205f, height - 0.01f},
                                         {0.195f, height},
                                         {0.0f, height}}};
    Mesh stool = lathe(seat, 48);
    for (glm::vec2& uv : stool.uvs) uv *= glm::vec2(1.0f, 0.12f); // of one board
    const float foot = 0.17f, top = 0.12f;
    for (float x : {-1.0f, 1.0f}) {
        for (float z : {-1.0f, 1.0f}) {
            const glm::vec3 from(foot * x, 0.0f, foot * z), to(top * x, height - 0.02f, top * z);
            stool.append(frustum(0.014f, 0.019f, glm::distance(from, to), 16), standing(from, to));
        }
    }
    glb.add("stool", stool, wood, place);
    return height;
}

Mesh carafe() {
    const std::array<glm::vec2, 23> outline{
        {{0.0f, 0.0f},     {0.06f, 0.0f},    {0.075f, 0.004f},  {0.083f, 0.015f},  {0.086f, 0.04f},
         {0.081f, 0.085f}, {0.066f, 0.125f}, {0.045f, 0.16f},   {0.033f, 0.19f},   {0.031f, 0.22f},
         {0.037f, 0.25f},  {0.047f, 0.275f}, {0.0455f, 0.279f}, {0.0425f, 0.277f}, {0.032f, 0.251f},
         {0.025f, 0.221f}, {0.027f, 0.189f}, {0.039f, 0.158f},  {0.06f, 0.122f},   {0.075f, 0.083f},
         {0.08f, 0.04f},   {0.072f, 0.018f}, {0.0f, 0.012f}}};
    return lathe(outline, 48);
}

void addWateringCan(GlbWriter& glb, const glm::mat4& place, int metal) {
    const std::array<glm::vec2, 9> body{{{0.0f, 0.0f},
                                         {0.105f, 0.0f},
                                         {0.11f, 0.01f},
                                         {0.1f, 0.2f},
                                         {0.07f, 0.235f},
                                         {0.066f, 0.235f},
                                         {0.094f, 0.198f},
                                         {0.104f, 0.012f},
                                         {0.0f, 0.008f}}};
    Mesh can = lathe(body, 40);
    const glm::vec3 root(0.09f, 0.05f, 0.0f), mouth(0.3f, 0.27f, 0.0f);
    can.append(frustum(0.022f, 0.013f, glm::distance(root, mouth), 20), standing(root, mouth));
    can.append(frustum(0.014f, 0.04f, 0.05f, 24), standing(mouth, mouth + 0.1f * (mouth - root)));
    std::vector<glm::vec2> ring; // of a torus
    const int corners = 8;
    for (int i = 0; i <= corners; i++) {
        const float angle = glm::radians(360.0f / corners * static_cast<float>(i % corners));
        ring.emplace_back(0.085f + 0.008f * std::cos(angle), 0.008f * std::sin(angle));
    }
    const Mesh handle = lathe(ring, 32);
    can.append(handle, translation({-0.12f, 0.15f, 0.0f}) * rotationX(90.0f));
    can.append(handle, translation({0.0f, 0.245f, 0.0f}) * rotationX(90.0f) * scaling(glm::vec3(0.8f)));
    glb.add("watering can", can, metal, place);
}

Pots::Pots(GlbWriter& glb)
    : glb_(glb) {
    const int clay = glb.addMaterial({.name = "terracotta", .baseColor = {0.68f, 0.31f, 0.18f}});
    const int earth = glb.addMaterial({.name = "soil", .baseColor = {0.09f, 0.065f, 0.045f}});
    const std::array<glm::vec2, 9> outline{{{0.0f, 0.0f},
                                            {0.095f, 0.0f},
                                            {0.13f, 0.19f},
                                            {0.148f, 0.195f},
                                            {0.152f, 0.26f},
                                            {0.132f, 0.26f},
                                            {0.125f, 0.2f},
                                            {0.1f, 0.03f},
                                            {0.0f, 0.03f}}};
    Mesh pot = lathe(outline, 32);
    for (glm::vec3 p : pot.positions)
        pot.colors.push_back(
            glm::mix(glm::vec3(0.78f, 0.9f, 1.0f), glm::vec3(1.0f), glm::smoothstep(0.0f, 0.15f, p.y)));
    Mesh soil;
    soil.append(frustum(0.11f, 0.13f, 0.03f, 24), translation({0.0f, 0.21f, 0.0f}));
    const std::array<GlbWriter::Part, 2> parts{{{&pot, clay}, {&soil, earth}}};
    pot_ = glb.addMesh("pot", parts);
    cord_ = glb.addMesh("cord", frustum(0.003f, 0.003f, 1.0f, 6), earth);
}

glm::mat4 Pots::place(glm::vec3 at, float scale, float turn) {
    const glm::mat4 placed = translation(at) * rotationY(turn);
    glb_.addNode("pot", pot_, placed * scaling(glm::vec3(scale)));
    return placed * translation({0.0f, 0.235f * scale, 0.0f});
}

glm::mat4 Pots::hang(glm::vec3 at, float scale, float height) {
    const glm::vec3 top(at.x, height, at.z);
    for (float turn : {20.0f, 140.0f, 260.0f}) {
        const glm::vec3 rim = glm::vec3(rotationY(turn) * glm::vec4(0.0f, 0.25f, 0.145f, 0.0f)) * scale + at;
        glb_.addNode("cord", cord_, standing(rim, top) * scaling({1.0f, glm::distance(rim, top), 1.0f}));
    }
    return place(at, scale, 0.0f);
}

} // namespace irradia::scenes
