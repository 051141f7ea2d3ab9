// The vertices of a primitive as its accessors state them.
#pragma once

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/file.h"
#include "engine/scene/scene.h"
#include <optional>

namespace irradia::gltf {

// The coordinates at which a vertex meets a texture.
glm::vec2 textureCoordinates(const Vertex& vertex, const TextureRef& texture);

class VertexReader {
public:
    // Tangents are read where the material has a normal map.
    VertexReader(const SourceFile& source, const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                 const Thing& owner, const Material& material);

    uint64_t count() const { return positions_->count(); }
    bool hasCoordinates(int set) const { return uv_[set].has_value(); }
    bool hasTangents() const { return tangents_.has_value(); }

    // Where vertex i meets a texture whose coordinates there are.
    glm::vec2 coordinates(uint64_t i, const TextureRef& texture);

    // Normals and tangents are not unit yet; a zero normal stands for none.
    Vertex read(uint64_t i);

    // Warns of what was mended in reading.
    void noteMends() const;

private:
    using View = std::optional<AccessorView>;

    glm::vec2 readUv(int set, uint64_t i);
    glm::vec4 readColor(uint64_t i);

    const SourceFile& source_;
    const Thing& owner_;
    View positions_, normals_, tangents_, colors_;
    View uv_[2];
    bool hasAlpha_ = false; // colours of four components
    bool badUv_ = false, badColor_ = false;
};

} // namespace irradia::gltf
