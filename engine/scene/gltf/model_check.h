// The parts validateModel is made of. Each throws BadData at the first fault of its share.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

class ModelCheck {
public:
    ModelCheck(const SourceFile& source, const tinygltf::Model& model)
        : source_(source)
        , model_(model) {}

protected:
    enum class Need { Required, Optional }; // an absent index is -1

    void checkIndex(const std::string& owner, std::string_view kind, int index, size_t size,
                    Need need) const {
        if (index == -1 && need == Need::Optional) return;
        if (index < 0 || static_cast<size_t>(index) >= size)
            source_.refuse("{}: UNRESOLVED_REFERENCE: {} {} of {}", owner, kind, index, size);
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
};

// Buffer views and accessors lie within their buffers.
void checkData(const SourceFile& source, const tinygltf::Model& model);

// The nodes are a forest of transforms, and scenes list its roots. Indices of meshes and cameras are checked
// too.
void checkNodes(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
