#include "engine/scene/gltf/vertex_reader.h"

#include <algorithm>
#include <cmath>

namespace irradia::gltf {
namespace {

constexpr float kMaxUv = 1e6f; // beyond it a float no longer resolves a texel of the repeated picture
constexpr float kMaxColor = 1e6f;

std::optional<AccessorView> attribute(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                      const std::string& name) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    return std::optional<AccessorView>(std::in_place, model, found->second);
}

bool isUsable(glm::vec3 direction) {
    const float length2 = glm::dot(direction, direction);
    return std::isfinite(length2) && length2 > 1e-20f;
}

glm::vec2 transformed(const TextureRef& texture, glm::vec2 uv) {
    return texture.transform * glm::vec3(uv, 1.0f);
}

} // namespace

glm::vec2 textureCoordinates(const Vertex& vertex, const TextureRef& texture) {
    return transformed(texture, vertex.uv[texture.uvSet]);
}

VertexReader::VertexReader(const SourceFile& source, const tinygltf::Model& model,
                           const tinygltf::Primitive& primitive, const Thing& owner, const Material& material,
                           const Pose& pose)
    : source_(source)
    , owner_(owner)
    , positions_(attribute(model, primitive, "POSITION"))
    , normals_(attribute(model, primitive, "NORMAL"))
    // glTF 2.0, 3.7.2.1: without normals, tangents are to be ignored.
    , tangents_(material.normalTexture.image >= 0 && normals_ ? attribute(model, primitive, "TANGENT")
                                                              : std::nullopt)
    , colors_(attribute(model, primitive, "COLOR_0"))
    , uv_{attribute(model, primitive, "TEXCOORD_0"), attribute(model, primitive, "TEXCOORD_1")}
    , morphing_(model, primitive, pose)
    , skinning_(source, model, primitive, owner, pose) {
    if (colors_) hasAlpha_ = model.accessors[primitive.attributes.at("COLOR_0")].type == TINYGLTF_TYPE_VEC4;
}

Vertex VertexReader::read(uint64_t i) {
    Vertex vertex;
    vertex.position = positions_->element(i);
    if (normals_) vertex.normal = normals_->element(i);
    if (tangents_) vertex.tangent = tangents_->element(i);
    morphing_.apply(i, vertex);
    skinning_.apply(i, vertex);
    if (!normals_ || !isUsable(vertex.normal)) vertex.normal = glm::vec3(0.0f);
    const bool hasTangent = tangents_ && isUsable(vertex.tangent);
    const float handedness = vertex.tangent.w < 0 ? -1.0f : 1.0f;
    vertex.tangent = hasTangent ? glm::vec4(glm::vec3(vertex.tangent), handedness) : glm::vec4(0.0f);
    for (int set = 0; set < 2; ++set)
        if (uv_[set]) vertex.uv[set] = readUv(set, i);
    if (colors_) vertex.color = readColor(i);
    return vertex;
}

glm::vec2 VertexReader::coordinates(uint64_t i, const TextureRef& texture) {
    return transformed(texture, readUv(texture.uvSet, i));
}

glm::vec2 VertexReader::readUv(int set, uint64_t i) {
    const glm::vec2 uv = uv_[set]->element(i);
    if (std::abs(uv.x) <= kMaxUv && std::abs(uv.y) <= kMaxUv) return uv;
    badUv_ = true;
    return glm::vec2(0.0f);
}

glm::vec4 VertexReader::readColor(uint64_t i) {
    glm::vec4 color = colors_->element(i);
    if (!hasAlpha_) color.a = 1.0f;
    for (int c = 0; c < 4; ++c) {
        if (color[c] >= 0.0f && color[c] <= kMaxColor) continue;
        badColor_ = true;
        color[c] = std::isnan(color[c]) ? 0.0f : std::clamp(color[c], 0.0f, kMaxColor);
    }
    return color;
}

void VertexReader::noteMends() const {
    skinning_.noteMends();
    if (badUv_)
        source_.warn(owner_, "ACCESSOR_INVALID_FLOAT",
                     "texture coordinates that are not finite or beyond {} are taken as 0", kMaxUv);
    if (badColor_)
        source_.warn(owner_, "ACCESSOR_INVALID_FLOAT",
                     "colours that are negative, above {0} or not finite are clamped to 0 to {0}, NaN to 0",
                     kMaxColor);
}

} // namespace irradia::gltf
