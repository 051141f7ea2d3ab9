// The meshes that placed nodes show: each read once for every pose it is in, placed by every node that shows
// it.
#pragma once

#include "engine/scene/gltf/instancing.h"
#include "engine/scene/gltf/nodes.h"
#include "engine/scene/gltf/primitives.h"
#include <map>

namespace irradia::gltf {

class ShownMeshes {
public:
    // The model has passed validateModel, and must outlive this.
    ShownMeshes(const SourceFile& source, const tinygltf::Model& model, const std::vector<Placement>& nodes,
                const Scene& scene);

    // Calls visit(primitive, toWorld) for each primitive of each instance.
    template <typename Visit>
    void forEach(Visit&& visit) const {
        for (const Shown& shown : shown_) {
            if (shown.primitives->empty()) continue;
            for (uint64_t i = 0; i < shown.instancing.count(); ++i) {
                const glm::dmat4 toWorld = shown.toWorld * shown.instancing.transform(i);
                for (const PrimitiveMesh& primitive : *shown.primitives) visit(primitive, toWorld);
            }
        }
    }

private:
    struct Shown {
        const std::vector<PrimitiveMesh>* primitives;
        glm::dmat4 toWorld;
        Instancing instancing;
    };
    // A mesh, and the node whose pose it is in; -1 = the mesh's own.
    using PosedMesh = std::pair<int, int>;

    std::map<PosedMesh, std::vector<PrimitiveMesh>> meshes_;
    std::vector<Shown> shown_;
};

} // namespace irradia::gltf
