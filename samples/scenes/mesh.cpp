#include "mesh.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace irradia::scenes {

uint32_t Mesh::addVertex(glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
    positions.push_back(position);
    normals.push_back(normal);
    uvs.push_back(uv);
    return static_cast<uint32_t>(positions.size() - 1);
}

void Mesh::addTriangle(uint32_t a, uint32_t b, uint32_t c) {
    if (positions[a] == positions[b] || positions[b] == positions[c] || positions[c] == positions[a]) return;
    indices.insert(indices.end(), {a, b, c});
}

void Mesh::addQuad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    addTriangle(a, b, c);
    addTriangle(a, c, d);
}

void Mesh::addGrid(uint32_t first, uint32_t columns, uint32_t rows) {
    for (uint32_t row = 0; row < rows; row++) {
        for (uint32_t column = 0; column < columns; column++) {
            const uint32_t a = first + row * (columns + 1) + column;
            const uint32_t d = a + columns + 1;
            addQuad(a, a + 1, d + 1, d);
        }
    }
}

void Mesh::addFlatQuad(const std::array<glm::vec3, 4>& p) {
    const glm::vec3 n = glm::normalize(glm::cross(p[2] - p[0], p[3] - p[1]));
    const uint32_t first = addVertex(p[0], n, {0.0f, 1.0f});
    addVertex(p[1], n, {1.0f, 1.0f});
    addVertex(p[2], n, {1.0f, 0.0f});
    addVertex(p[3], n, {0.0f, 0.0f});
    addQuad(first, first + 1, first + 2, first + 3);
}

Mesh& Mesh::paint(glm::vec3 color) {
    colors.assign(positions.size(), color);
    return *this;
}

Mesh& Mesh::append(const Mesh& other, const glm::mat4& transform) {
    const auto first = static_cast<uint32_t>(positions.size());
    const glm::mat3 forNormals = glm::transpose(glm::inverse(glm::mat3(transform)));
    for (glm::vec3 p : other.positions) positions.push_back(glm::vec3(transform * glm::vec4(p, 1.0f)));
    for (glm::vec3 n : other.normals) normals.push_back(glm::normalize(forNormals * n));
    uvs.insert(uvs.end(), other.uvs.begin(), other.uvs.end());
    colors.insert(colors.end(), other.colors.begin(), other.colors.end());
    for (uint32_t index : other.indices) indices.push_back(first + index);
    return *this;
}

void Mesh::computeTangents() {
    std::vector<glm::vec3> alongU(positions.size(), glm::vec3(0.0f));
    std::vector<float> handedness(positions.size(), 1.0f);
    for (size_t i = 0; i < indices.size(); i += 3) {
        const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        const glm::vec3 e1 = positions[b] - positions[a], e2 = positions[c] - positions[a];
        const glm::vec2 d1 = uvs[b] - uvs[a], d2 = uvs[c] - uvs[a];
        const float area = d1.x * d2.y - d1.y * d2.x; // negative where u, v and the normal are unmirrored
        const glm::vec3 dpdu = (e1 * d2.y - e2 * d1.y) / area;
        for (uint32_t corner : {a, b, c}) {
            alongU[corner] += dpdu;
            handedness[corner] = area < 0.0f ? 1.0f : -1.0f;
        }
    }
    tangents.clear();
    for (size_t i = 0; i < positions.size(); i++) {
        const glm::vec3 n = normals[i];
        const glm::vec3 t = glm::normalize(alongU[i] - n * glm::dot(n, alongU[i]));
        tangents.emplace_back(t, handedness[i]);
    }
}

glm::mat4 translation(glm::vec3 offset) {
    return glm::translate(glm::mat4(1.0f), offset);
}

glm::mat4 scaling(glm::vec3 factors) {
    return glm::scale(glm::mat4(1.0f), factors);
}

static glm::mat4 rotation(float degrees, glm::vec3 axis) {
    return glm::rotate(glm::mat4(1.0f), glm::radians(degrees), axis);
}

glm::mat4 rotationX(float degrees) {
    return rotation(degrees, {1.0f, 0.0f, 0.0f});
}
glm::mat4 rotationY(float degrees) {
    return rotation(degrees, {0.0f, 1.0f, 0.0f});
}
glm::mat4 rotationZ(float degrees) {
    return rotation(degrees, {0.0f, 0.0f, 1.0f});
}

glm::mat4 standing(glm::vec3 from, glm::vec3 to) {
    const glm::vec3 y = glm::normalize(to - from);
    const bool isUpright = std::abs(y.y) > 0.9999f;
    const glm::vec3 x =
        isUpright ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::normalize(glm::cross(y, glm::vec3(0.0f, 1.0f, 0.0f)));
    return {glm::vec4(x, 0.0f), glm::vec4(y, 0.0f), glm::vec4(glm::cross(x, y), 0.0f), glm::vec4(from, 1.0f)};
}

} // namespace irradia::scenes
