#include "primitives.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <utility>

namespace irradia::scenes {

namespace {

// Where a rounded box's grid lies along one axis: equal angles of the rounding, one step over the flat
// middle.
std::vector<float> roundedTicks(float half, float radius, uint32_t segments) {
    std::vector<float> ticks;
    const float quarter = glm::quarter_pi<float>();
    for (uint32_t i = 0; i <= segments; i++) {
        const float angle = quarter * static_cast<float>(i) / static_cast<float>(segments);
        ticks.push_back(i == segments ? half : half - radius + radius * std::tan(angle));
    }
    std::vector<float> all;
    for (auto tick = ticks.rbegin(); tick != ticks.rend(); ++tick) all.push_back(-*tick);
    all.insert(all.end(), ticks.begin(), ticks.end());
    return all;
}

} // namespace

Mesh quad(glm::vec3 corner, glm::vec3 across, glm::vec3 up, glm::vec2 repeat) {
    Mesh mesh;
    mesh.addFlatQuad({corner, corner + across, corner + across + up, corner + up});
    for (glm::vec2& uv : mesh.uvs) uv *= repeat;
    return mesh;
}

Mesh box(glm::vec3 a, glm::vec3 b) {
    Mesh mesh;
    mesh.addFlatQuad({{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}}); // +z
    mesh.addFlatQuad({{{b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}}}); // -z
    mesh.addFlatQuad({{{b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}}}); // +x
    mesh.addFlatQuad({{{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}}); // -x
    mesh.addFlatQuad({{{a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}}}); // +y
    mesh.addFlatQuad({{{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}}); // -y
    return mesh;
}

Mesh roundedBox(glm::vec3 half, float radius, uint32_t segments) {
    Mesh mesh;
    const auto steps = 2 * segments + 1;
    const glm::vec3 core = half - radius;
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const std::vector<float> us = roundedTicks(half[u], radius, segments);
        const std::vector<float> vs = roundedTicks(half[v], radius, segments);
        for (float side : {1.0f, -1.0f}) {
            const auto first = static_cast<uint32_t>(mesh.positions.size());
            for (uint32_t row = 0; row <= steps; row++) {
                for (uint32_t column = 0; column <= steps; column++) {
                    glm::vec3 onBox;
                    onBox[axis] = side * half[axis];
                    onBox[u] = us[side > 0.0f ? column : steps - column]; // the far side runs backwards
                    onBox[v] = vs[row];
                    const glm::vec3 inner = glm::clamp(onBox, -core, core);
                    const glm::vec3 normal = glm::normalize(onBox - inner);
                    const glm::vec2 uv = glm::vec2(onBox[u] / half[u], -onBox[v] / half[v]) * 0.5f + 0.5f;
                    mesh.addVertex(inner + radius * normal, normal, uv);
                }
            }
            mesh.addGrid(first, steps, steps);
        }
    }
    return mesh;
}

Mesh lathe(std::span<const glm::vec2> outline, uint32_t slices) {
    const auto segments = outline.size() - 1;
    const bool ring = outline.front() == outline.back();
    std::vector<glm::vec2> normals; // of each segment: the outline's direction turned to the right
    for (size_t i = 0; i < segments; i++) {
        const glm::vec2 d = outline[i + 1] - outline[i];
        normals.push_back(glm::normalize(glm::vec2(d.y, -d.x)));
    }
    const float cosCrease = std::cos(glm::radians(40.0f));
    const auto blend = [&](size_t own, size_t neighbour, bool exists) {
        const bool smooth = exists && glm::dot(normals[own], normals[neighbour]) > cosCrease;
        return smooth ? glm::normalize(normals[own] + normals[neighbour]) : normals[own];
    };
    Mesh mesh;
    for (size_t i = 0; i < segments; i++) {
        const std::array ends{blend(i, i == 0 ? segments - 1 : i - 1, i > 0 || ring),
                              blend(i, (i + 1) % segments, i + 1 < segments || ring)};
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (size_t end = 0; end < 2; end++) {
            const glm::vec2 point = outline[i + end];
            const float v = 1.0f - static_cast<float>(i + end) / static_cast<float>(segments);
            for (uint32_t slice = 0; slice <= slices; slice++) {
                const float turn =
                    static_cast<float>(slice % slices) / static_cast<float>(slices); // seam closes
                const float angle = glm::two_pi<float>() * turn;
                const glm::vec3 outwards(std::sin(angle), 0.0f, std::cos(angle));
                mesh.addVertex(outwards * point.x + glm::vec3(0.0f, point.y, 0.0f),
                               outwards * ends[end].x + glm::vec3(0.0f, ends[end].y, 0.0f),
                               {static_cast<float>(slice) / static_cast<float>(slices), v});
            }
        }
        mesh.addGrid(first, slices, 1);
    }
    return mesh;
}

Mesh sphere(float radius, uint32_t slices, uint32_t stacks) {
    std::vector<glm::vec2> outline;
    for (uint32_t i = 0; i <= stacks; i++) {
        const float angle = glm::pi<float>() * static_cast<float>(i) / static_cast<float>(stacks);
        const bool pole = i == 0 || i == stacks;
        outline.emplace_back(pole ? 0.0f : radius * std::sin(angle), -radius * std::cos(angle));
    }
    return lathe(outline, slices);
}

Mesh frustum(float bottomRadius, float topRadius, float height, uint32_t slices) {
    const std::array<glm::vec2, 4> outline{
        {{0.0f, 0.0f}, {bottomRadius, 0.0f}, {topRadius, height}, {0.0f, height}}};
    return lathe(outline, slices);
}

Mesh icosphere(uint32_t levels) {
    Mesh mesh;
    const float g = glm::golden_ratio<float>();
    const std::array<glm::vec3, 12> corners{{{-1, g, 0},
                                             {1, g, 0},
                                             {-1, -g, 0},
                                             {1, -g, 0},
                                             {0, -1, g},
                                             {0, 1, g},
                                             {0, -1, -g},
                                             {0, 1, -g},
                                             {g, 0, -1},
                                             {g, 0, 1},
                                             {-g, 0, -1},
                                             {-g, 0, 1}}};
    const auto add = [&](glm::vec3 p) {
        const glm::vec3 n = glm::normalize(p);
        const glm::vec2 uv(std::atan2(n.x, n.z) / glm::two_pi<float>() + 0.5f,
                           std::acos(n.y) / glm::pi<float>());
        return mesh.addVertex(n, n, uv);
    };
    for (glm::vec3 corner : corners) add(corner);
    mesh.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                    4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                    6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    for (uint32_t level = 0; level < levels; level++) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), 0u);
            if (isNew) entry->second = add(mesh.positions[a] + mesh.positions[b]);
            return entry->second;
        };
        const std::vector<uint32_t> coarse = std::exchange(mesh.indices, {});
        for (size_t i = 0; i < coarse.size(); i += 3) {
            const uint32_t a = coarse[i], b = coarse[i + 1], c = coarse[i + 2];
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            mesh.indices.insert(mesh.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
    }
    return mesh;
}

Mesh octahedron(float radius) {
    Mesh mesh;
    for (float x : {radius, -radius}) {
        for (float y : {radius, -radius}) {
            for (float z : {radius, -radius}) {
                std::array<glm::vec3, 3> p{{{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
                if (x * y * z < 0.0f) std::swap(p[0], p[1]);
                const glm::vec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
                const uint32_t first = mesh.addVertex(p[0], n, {0.0f, 1.0f});
                mesh.addVertex(p[1], n, {1.0f, 1.0f});
                mesh.addVertex(p[2], n, {0.5f, 0.0f});
                mesh.addTriangle(first, first + 1, first + 2);
            }
        }
    }
    return mesh;
}

Mesh wallWithOpening(Rectangle wall, Rectangle opening, float thickness) {
    const auto corners = [](Rectangle r, float z) {
        return std::array<glm::vec3, 4>{
            {{r.lower, z}, {r.upper.x, r.lower.y, z}, {r.upper, z}, {r.lower.x, r.upper.y, z}}};
    };
    const auto outer = corners(wall, 0.0f), outerBack = corners(wall, -thickness);
    const auto inner = corners(opening, 0.0f), innerBack = corners(opening, -thickness);
    Mesh mesh;
    for (size_t i = 0; i < 4; i++) {
        const size_t next = (i + 1) % 4;
        mesh.addFlatQuad({outer[i], outer[next], inner[next], inner[i]});
        mesh.addFlatQuad({outerBack[next], outerBack[i], innerBack[i], innerBack[next]});
        mesh.addFlatQuad({outerBack[i], outerBack[next], outer[next], outer[i]});
        mesh.addFlatQuad({inner[i], inner[next], innerBack[next], innerBack[i]});
    }
    return mesh;
}

} // namespace irradia::scenes
