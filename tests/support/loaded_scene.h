// Small glTF files as the loader reads them, where the file has them.
#pragma once

#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"

namespace irradia::test {

inline Scene load(const GltfBuilder& builder) {
    const TempFolder folder;
    return loadScene(folder.write("scene.glb", builder.glb()));
}

inline glm::vec3 corner(const Scene& scene, size_t triangle, int c) {
    return glm::vec3(scene.origin + glm::dvec3(scene.vertices[scene.triangles[triangle].vertex[c]].position));
}

inline glm::vec3 faceNormal(const Scene& scene, size_t t) {
    return glm::normalize(
        glm::cross(corner(scene, t, 1) - corner(scene, t, 0), corner(scene, t, 2) - corner(scene, t, 0)));
}

} // namespace irradia::test
