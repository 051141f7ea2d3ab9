// A mesh to compress, and what tests of compressed files share.
#pragma once

#include "engine/error.h"
#include "tests/support/loaded_scene.h"
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <random>

namespace irradia::test {

using Bytes = std::vector<uint8_t>;

// A grid of 9 x 9 points, 128 triangles.
inline constexpr int kSide = 9;

inline std::vector<glm::vec3> gridPoints() {
    std::vector<glm::vec3> points;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) points.push_back(glm::vec3(x, y, 0.5f * float(x * y % 3)) * 0.25f);
    return points;
}

inline std::vector<uint32_t> gridIndices() {
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y + 1 < kSide; ++y)
        for (uint32_t x = 0; x + 1 < kSide; ++x) {
            const uint32_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
            indices.insert(indices.end(), {a, b, d, a, d, c});
        }
    return indices;
}

inline constexpr size_t kPoints = kSide * kSide, kCorners = 6 * (kSide - 1) * (kSide - 1);

// The corners of all triangles, each from its least, in one order whatever they were stored in.
inline std::vector<std::array<float, 9>> sortedTriangles(const Scene& scene) {
    std::vector<std::array<float, 9>> triangles;
    for (const Triangle& triangle : scene.triangles) {
        std::array<glm::vec3, 3> p;
        for (int c = 0; c < 3; ++c) p[c] = scene.vertices[triangle.vertex[c]].position;
        const auto less = [](const glm::vec3& a, const glm::vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        std::ranges::rotate(p, std::ranges::min_element(p, less));
        triangles.push_back({p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z});
    }
    std::ranges::sort(triangles);
    return triangles;
}

// The grid as it is.
inline Scene plainGrid() {
    GltfBuilder builder;
    const int indices = builder.accessor(builder.view(gridIndices()), 5125, kCorners, "SCALAR");
    builder.mesh({{"attributes", {{"POSITION", builder.vec3(gridPoints())}}}, {"indices", indices}});
    return load(builder);
}

inline int emptyAccessor(GltfBuilder& builder, int componentType, size_t count, const std::string& type) {
    builder.json["accessors"].push_back({{"componentType", componentType}, {"count", count}, {"type", type}});
    return static_cast<int>(builder.json["accessors"].size()) - 1;
}

// A file with some of its bytes changed at random does no worse than an error.
inline void checkDamage(const std::string& glb, int rounds) {
    const TempFolder folder;
    std::mt19937 random(7);
    const size_t begin = glb.find("BIN") + 5;
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
        std::string changed = glb;
        for (auto k = random() % 4 + 1; k > 0; --k)
            changed[begin + random() % (glb.size() - begin)] = static_cast<char>(random());
        try {
            const Scene scene = loadScene(folder.write("fuzz.glb", changed));
            for (const Triangle& triangle : scene.triangles)
                for (int c = 0; c < 3; ++c) REQUIRE(triangle.vertex[c] < scene.vertices.size());
        } catch (const Error& error) {
            REQUIRE((error.code() == ExitCode::BadData || error.code() == ExitCode::OutOfMemory));
            ++refused;
        }
    }
    CHECK(refused > 0);
}

inline Json& primitiveOf(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0];
}

} // namespace irradia::test
