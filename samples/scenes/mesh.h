// A triangle mesh as glTF holds it, and what can be done to one. Metres, y up, counter-clockwise = front.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace irradia::scenes {

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // one a position, or none: flat faces
    std::vector<glm::vec2> uvs;      // one a position, or none; v downwards
    std::vector<glm::vec4> tangents; // one a position, or none; w = handedness
    std::vector<glm::vec3> colors;   // one a position, or none; linear, times the base colour
    std::vector<uint32_t> indices;

    uint32_t addVertex(glm::vec3 position, glm::vec3 normal, glm::vec2 uv);

    // Adds a triangle unless two of its corners lie in one point (the pole of a lathe).
    void addTriangle(uint32_t a, uint32_t b, uint32_t c);

    // Adds (a, b, c) and (a, c, d).
    void addQuad(uint32_t a, uint32_t b, uint32_t c, uint32_t d);

    // Joins rows of vertices, (columns + 1) wide, from `first` on; quads face the side where columns run
    // right and rows up.
    void addGrid(uint32_t first, uint32_t columns, uint32_t rows);

    // Four corners of a plane, counter-clockwise from the lower left, with its normal and uv 0..1.
    void addFlatQuad(const std::array<glm::vec3, 4>& corners);

    // Gives all vertices one colour.
    Mesh& paint(glm::vec3 color);

    // Either both have colours or none, unless one is empty.
    Mesh& append(const Mesh& other, const glm::mat4& transform = glm::mat4(1.0f));

    // Tangent space for a normal map whose green axis points to the top row: tangent along +u,
    // cross(normal, tangent) along -v.
    void computeTangents();
};

glm::mat4 translation(glm::vec3 offset);
glm::mat4 scaling(glm::vec3 factors);
glm::mat4 rotationX(float degrees);
glm::mat4 rotationY(float degrees);
glm::mat4 rotationZ(float degrees);

// Puts the origin at `from` and the y axis towards `to`, the x axis level.
glm::mat4 standing(glm::vec3 from, glm::vec3 to);

} // namespace irradia::scenes
