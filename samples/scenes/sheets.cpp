#include "sheets.h"

namespace irradia::scenes {

namespace {

glm::vec3 normalAt(const Surface& surface, float u, float v) {
    const float h = 1e-3f;
    return glm::normalize(
        glm::cross(surface(u + h, v) - surface(u - h, v), surface(u, v + h) - surface(u, v - h)));
}

// One side, 1 or -1, which lies `distance` before the surface.
void addSide(Mesh& mesh, const Surface& surface, uint32_t nu, uint32_t nv, float side, float distance) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t row = 0; row <= nv; row++) {
        for (uint32_t column = 0; column <= nu; column++) {
            const float u = static_cast<float>(side > 0.0f ? column : nu - column) / static_cast<float>(nu);
            const float v = static_cast<float>(row) / static_cast<float>(nv);
            const glm::vec3 n = side * normalAt(surface, u, v);
            mesh.addVertex(surface(u, v) + distance * n, n, {u, 1.0f - v});
        }
    }
    mesh.addGrid(first, nu, nv);
}

} // namespace

Mesh sheet(const Surface& surface, uint32_t nu, uint32_t nv, float thickness) {
    Mesh mesh;
    for (float side : {1.0f, -1.0f}) addSide(mesh, surface, nu, nv, side, 0.5f * thickness);
    // The rim joins front (column, row) with the back's mirrored column.
    const uint32_t back = (nu + 1) * (nv + 1);
    const auto front = [&](uint32_t column, uint32_t row) { return mesh.positions[row * (nu + 1) + column]; };
    const auto behind = [&](uint32_t column, uint32_t row) {
        return mesh.positions[back + row * (nu + 1) + nu - column];
    };
    const auto rim = [&](uint32_t c0, uint32_t r0, uint32_t c1, uint32_t r1) {
        mesh.addFlatQuad({behind(c0, r0), behind(c1, r1), front(c1, r1), front(c0, r0)});
    };
    for (uint32_t c = 0; c < nu; c++) {
        rim(c, 0, c + 1, 0);
        rim(c + 1, nv, c, nv);
    }
    for (uint32_t r = 0; r < nv; r++) {
        rim(0, r + 1, 0, r);
        rim(nu, r, nu, r + 1);
    }
    return mesh;
}

Mesh openSheet(const Surface& surface, uint32_t nu, uint32_t nv) {
    Mesh mesh;
    addSide(mesh, surface, nu, nv, 1.0f, 0.0f);
    return mesh;
}

} // namespace irradia::scenes
