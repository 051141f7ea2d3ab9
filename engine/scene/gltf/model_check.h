// The parts validateModel is made of. Where findings are collected, each thing is checked on its own.
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

    // The index that stands at `owner`.
    void checkIndex(const Thing& owner, std::string_view kind, int index, size_t size, Need need) const {
        if (index == -1 && need == Need::Optional) return;
        if (index < 0 || static_cast<size_t>(index) >= size)
            source_.refuse(owner, "UNRESOLVED_REFERENCE", "{} {} of {}", kind, index, size);
    }

    // A check of its own: whether it passed. Loading ends where it does not.
    template <typename Check>
    bool attempt(Check&& check) const {
        return source_.attempt(Thing{}, {}, check);
    }

    // Checks of every element of an array: whether all passed.
    template <typename Array, typename Check>
    bool each(const Array& array, Check&& check) const {
        bool areGood = true;
        for (size_t i = 0; i < array.size(); ++i) areGood = attempt([&] { check(i); }) && areGood;
        return areGood;
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
};

// Buffer views and accessors lie within their buffers. True where all do.
bool checkData(const SourceFile& source, const tinygltf::Model& model);

// Samplers, textures and materials, extensions included, name what there is. True where all do.
bool checkMaterials(const SourceFile& source, const tinygltf::Model& model);

// Primitives and their attributes have the formats that glTF and KHR_mesh_quantization allow. True where all
// do.
bool checkMeshes(const SourceFile& source, const tinygltf::Model& model);

// The lights of KHR_lights_punctual have possible values, and nodes name those there are. True where all is
// well.
bool checkLights(const SourceFile& source, const tinygltf::Model& model);

// The nodes are a forest of transforms, and scenes list its roots. Indices of meshes and cameras are checked
// too. True where all is well.
bool checkNodes(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
