#include "engine/scene/gltf/tangents.h"

#include "engine/scene/gltf/vertex_reader.h"
#include <algorithm>
#include <cmath>

namespace irradia::gltf {
namespace {

float angleAt(glm::vec3 corner, glm::vec3 next, glm::vec3 previous) {
    const float cosine = glm::dot(glm::normalize(next - corner), glm::normalize(previous - corner));
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

bool isFinite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

float uvArea(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    const glm::vec2 first = b - a, second = c - a;
    return first.x * second.y - second.x * first.y;
}

void generateTangents(PrimitiveMesh& mesh, const TextureRef& normalMap) {
    for (const glm::uvec3& triangle : mesh.triangles) {
        const Vertex* v[3];
        glm::vec2 uv[3];
        for (int c = 0; c < 3; ++c) {
            v[c] = &mesh.vertices[triangle[c]];
            uv[c] = textureCoordinates(*v[c], normalMap);
        }
        const glm::vec3 edge1 = v[1]->position - v[0]->position, edge2 = v[2]->position - v[0]->position;
        const glm::vec2 uv1 = uv[1] - uv[0], uv2 = uv[2] - uv[0];
        const float area = uvArea(uv[0], uv[1], uv[2]);
        // dp/du without its positive scale
        const glm::vec3 alongU = glm::normalize((edge1 * uv2.y - edge2 * uv1.y) * (area < 0 ? -1.0f : 1.0f));
        if (area == 0.0f || !isFinite(alongU)) continue;
        for (int c = 0; c < 3; ++c) {
            const float angle = angleAt(v[c]->position, v[(c + 1) % 3]->position, v[(c + 2) % 3]->position);
            if (!std::isfinite(angle)) continue;
            glm::vec4& tangent = mesh.vertices[triangle[c]].tangent;
            tangent = glm::vec4(glm::vec3(tangent) + angle * alongU, area < 0 ? 1.0f : -1.0f);
        }
    }
}

} // namespace irradia::gltf
