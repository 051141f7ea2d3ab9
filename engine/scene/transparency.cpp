#include "engine/scene/transparency.h"

#include "shared/scene.h"
#include <algorithm>

namespace irradia {

bool isSheet(const Material& m) {
    return m.transmission > 0.0f && m.isThin;
}

bool isSolid(const Material& m) {
    return m.transmission > 0.0f && !m.isThin;
}

bool scattersTransmitted(const Material& m) {
    return isSolid(m) || (isSheet(m) && m.roughness * m.roughness > gpu::kMinAlpha);
}

bool mayLetThrough(const Scene& scene, const Triangle& triangle) {
    if (triangle.material >= scene.materials.size()) return false; // of scenes that are only traced
    const Material& m = scene.materials[triangle.material];
    if (isSheet(m)) return true;
    if (m.alphaMode == AlphaMode::Opaque) return false;
    const auto isOpaque = [&](uint32_t vertex) { return scene.vertices[vertex].color.a >= 1.0f; };
    return m.alpha < 1.0f || m.baseColorTexture.image >= 0 || !isOpaque(triangle.vertex.x) ||
           !isOpaque(triangle.vertex.y) || !isOpaque(triangle.vertex.z);
}

bool letsLightThrough(const Scene& scene) {
    return std::ranges::any_of(scene.materials, isSolid) ||
           std::ranges::any_of(scene.triangles, [&](const Triangle& t) { return mayLetThrough(scene, t); });
}

} // namespace irradia
