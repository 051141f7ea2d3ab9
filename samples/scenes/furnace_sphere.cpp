// A closed sphere seen from inside whose every point emits 1/2 and reflects 1/2 of what arrives: the radiance
// L obeys L = 1/2 + L / 2, so it is exactly 1 everywhere, whatever the shape.
#include "primitives.h"
#include "scenes.h"

#include <algorithm>

namespace irradia::scenes {

void writeFurnaceSphere(const std::filesystem::path& folder) {
    Mesh mesh = icosphere(4);
    // Flat faces, by leaving the normals out: a smooth normal would cut directions between it and the face's
    // plane.
    mesh.normals.clear();
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i], mesh.indices[i + 1]); // inwards

    GlbWriter glb;
    const int wall = glb.addMaterial(
        {.name = "furnace", .baseColor = glm::vec3(0.5f), .specular = 0.0f, .emission = glm::vec3(0.5f)});
    glb.add("sphere", mesh, wall);
    glb.addCamera("centre", glm::vec3(0.0f), {0.0f, 0.0f, -1.0f}, 60.0f);
    glb.write(folder / "furnace-sphere.glb");
}

} // namespace irradia::scenes
