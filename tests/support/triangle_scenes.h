// Scenes of bare triangles for the tests of building and tracing.
#pragma once

#include "engine/scene/scene.h"
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace irradia::test {

using Corners = std::array<glm::vec3, 3>;

inline Corners corners(const Scene& scene, uint32_t triangle) {
    const glm::uvec3 v = scene.triangles[triangle].vertex;
    return {scene.vertices[v.x].position, scene.vertices[v.y].position, scene.vertices[v.z].position};
}

inline void add(Scene& scene, const Corners& triangle) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    for (const glm::vec3& p : triangle) {
        Vertex vertex;
        vertex.position = p;
        scene.vertices.push_back(vertex);
    }
    Triangle t;
    t.vertex = glm::uvec3(first, first + 1, first + 2);
    scene.triangles.push_back(t);
}

class Random {
public:
    explicit Random(uint32_t seed)
        : engine_(seed) {}
    float uniform() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; } // [0, 1)
    glm::vec3 inCube() { return {2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1}; }
    glm::vec3 direction() {
        const float z = 2 * uniform() - 1;
        const float phi = 6.28318531f * uniform();
        const float r = std::sqrt(std::max(0.0f, 1 - z * z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937 engine_;
};

// Triangles of edges up to `size` with corners in a cube of half-width `scale` about `centre`.
inline Scene triangleSoup(uint32_t count, float size, uint32_t seed, float scale = 1.0f,
                          glm::vec3 centre = {}) {
    Scene scene;
    scene.name = "soup";
    Random random(seed);
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 p = random.inCube();
        const glm::vec3 q = p + size * random.inCube();
        const glm::vec3 r = p + size * random.inCube();
        add(scene, {centre + scale * p, centre + scale * q, centre + scale * r});
    }
    return scene;
}

// A closed sphere of 2 * rings * segments triangles (less at the poles) that share their corners exactly.
inline Scene closedSphere(uint32_t rings, uint32_t segments, float radius, glm::vec3 centre = {}) {
    const auto point = [&](uint32_t ring, uint32_t segment) {
        const double theta = 3.14159265358979 * ring / rings;
        const double phi = 6.28318530717959 * (segment % segments) / segments;
        const double s = ring == 0 || ring == rings ? 0.0 : std::sin(theta);
        return centre + radius * glm::vec3(s * std::cos(phi), std::cos(theta), s * std::sin(phi));
    };
    Scene scene;
    scene.name = "sphere";
    for (uint32_t i = 0; i < rings; ++i)
        for (uint32_t j = 0; j < segments; ++j) {
            const glm::vec3 a = point(i, j), b = point(i, j + 1), c = point(i + 1, j),
                            d = point(i + 1, j + 1);
            if (i > 0) add(scene, {a, b, d});
            if (i + 1 < rings) add(scene, {a, d, c});
        }
    return scene;
}

} // namespace irradia::test
