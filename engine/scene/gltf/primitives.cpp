#include "engine/scene/gltf/primitives.h"

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/tangents.h"
#include <cmath>
#include <optional>

namespace irradia::gltf {
namespace {

constexpr uint32_t kNone = ~0u;
constexpr float kMaxUv = 1e6f; // beyond it a float no longer resolves a texel of the repeated picture

using View = std::optional<AccessorView>;

View attribute(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? std::nullopt : View(std::in_place, model, found->second);
}

uint64_t cornerCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    if (!primitive.attributes.contains("POSITION")) return 0;
    return primitive.indices >= 0 ? model.accessors[primitive.indices].count : vertexCount(model, primitive);
}

// The positions in the index list of triangle t (glTF 2.0, 3.7.2.1).
glm::u64vec3 cornersOf(int mode, uint64_t t) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {t, t + 1 + t % 2, t + 2 - t % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {t + 1, t + 2, 0};
    default:
        return {3 * t, 3 * t + 1, 3 * t + 2};
    }
}

bool isUsable(glm::vec3 direction) {
    const float length2 = glm::dot(direction, direction);
    return std::isfinite(length2) && length2 > 1e-20f;
}

class PrimitiveReader {
public:
    PrimitiveReader(const SourceFile& source, const tinygltf::Model& model,
                    const tinygltf::Primitive& primitive, Thing owner, const Scene& scene)
        : source_(source)
        , model_(model)
        , primitive_(primitive)
        , owner_(std::move(owner))
        , positions_(attribute(model, primitive, "POSITION"))
        , normals_(attribute(model, primitive, "NORMAL"))
        , uv_{attribute(model, primitive, "TEXCOORD_0"), attribute(model, primitive, "TEXCOORD_1")} {
        mesh_.material = static_cast<uint32_t>(
            primitive.material >= 0 ? static_cast<size_t>(primitive.material) : scene.materials.size() - 1);
        const Material& material = scene.materials[mesh_.material];
        mapped_ = material.normalTexture.image >= 0;
        uvSet_ = material.normalTexture.uvSet;
        // glTF 2.0, 3.7.2.1: without normals, tangents are to be ignored.
        if (const auto tangent = primitive.attributes.find("TANGENT");
            mapped_ && normals_ && tangent != primitive.attributes.end())
            tangents_.emplace(model, tangent->second);
        noteMissingCoordinates(material);
    }

    PrimitiveMesh read() {
        const bool generates = mapped_ && !tangents_;
        slots_.assign(positions_->count() * 2, kNone);
        for (const glm::uvec3& source : sourceTriangles()) {
            const bool mirrored = generates && isMirrored(source);
            mesh_.triangles.push_back(
                {corner(source.x, mirrored), corner(source.y, mirrored), corner(source.z, mirrored)});
        }
        if (generates) generateTangents(mesh_, uvSet_);
        if (badUv_)
            source_.warn(owner_, "ACCESSOR_INVALID_FLOAT",
                         "texture coordinates that are not finite or beyond {} are taken as 0", kMaxUv);
        return std::move(mesh_);
    }

private:
    std::vector<glm::uvec3> sourceTriangles() const {
        const uint64_t count = triangleCount(model_, primitive_);
        if (primitive_.mode == TINYGLTF_MODE_TRIANGLES && cornerCount(model_, primitive_) % 3 != 0)
            source_.note(Severity::Warning, owner_.pointer, "MESH_PRIMITIVE_INCOMPATIBLE_MODE",
                         owner_.name + ": the last indices make no whole triangle and are left out");
        View indices;
        if (primitive_.indices >= 0) indices.emplace(model_, primitive_.indices);
        std::vector<glm::uvec3> triangles(count);
        for (uint64_t t = 0; t < count; ++t) {
            const glm::u64vec3 corners = cornersOf(primitive_.mode, t);
            for (int c = 0; c < 3; ++c)
                triangles[t][c] =
                    indices ? checkedIndex(*indices, corners[c]) : static_cast<uint32_t>(corners[c]);
        }
        return triangles;
    }

    uint32_t checkedIndex(const AccessorView& indices, uint64_t i) const {
        const uint32_t index = indices.index(i);
        if (index >= positions_->count())
            source_.refuse(owner_.at("indices"), "ACCESSOR_INDEX_OOB",
                           "accessor {} element {} is {}, there are {} vertices", primitive_.indices, i,
                           index, positions_->count());
        return index;
    }

    // The vertex for a corner. Sides of a mirrored texture meet in two vertices: their tangents differ. A
    // vertex that takes the flat normal is nobody else's.
    uint32_t corner(uint32_t source, bool mirrored) {
        uint32_t& slot = slots_[2 * uint64_t{source} + (mirrored ? 1 : 0)];
        if (slot != kNone) return slot;
        const Vertex vertex = readVertex(source);
        const auto index = static_cast<uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(vertex);
        if (vertex.normal != glm::vec3(0.0f)) slot = index;
        return index;
    }

    Vertex readVertex(uint64_t i) {
        Vertex vertex;
        vertex.position = positions_->element(i);
        if (normals_) {
            vertex.normal = normals_->element(i);
            if (!isUsable(vertex.normal)) vertex.normal = glm::vec3(0.0f);
        }
        if (tangents_) {
            const glm::vec4 tangent = tangents_->element(i);
            if (isUsable(tangent))
                vertex.tangent = glm::vec4(glm::vec3(tangent), tangent.w < 0 ? -1.0f : 1.0f);
        }
        for (int set = 0; set < 2; ++set)
            if (uv_[set]) vertex.uv[set] = readUv(set, i);
        return vertex;
    }

    glm::vec2 readUv(int set, uint64_t i) {
        const glm::vec2 uv = uv_[set]->element(i);
        if (std::abs(uv.x) <= kMaxUv && std::abs(uv.y) <= kMaxUv) return uv;
        badUv_ = true;
        return glm::vec2(0.0f);
    }

    bool isMirrored(const glm::uvec3& t) {
        if (!uv_[uvSet_]) return false;
        return uvArea(readUv(uvSet_, t.x), readUv(uvSet_, t.y), readUv(uvSet_, t.z)) > 0;
    }

    void noteMissingCoordinates(const Material& material) {
        for (const TextureRef* ref :
             {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
              &material.emissiveTexture, &material.specularTexture, &material.specularColorTexture})
            if (ref->image >= 0 && !uv_[ref->uvSet])
                source_.warn(owner_, "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "its material needs TEXCOORD_{}",
                             ref->uvSet);
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
    const tinygltf::Primitive& primitive_;
    Thing owner_;
    View positions_, normals_, tangents_;
    View uv_[2];
    bool mapped_ = false; // has a normal map
    int uvSet_ = 0;       // the normal map's
    bool badUv_ = false;
    std::vector<uint32_t> slots_; // the vertex by 2 * the file's + mirrored
    PrimitiveMesh mesh_;
};

} // namespace

Thing primitiveThing(size_t index, const tinygltf::Mesh& mesh, size_t primitive) {
    return thing("mesh", "meshes", index, mesh.name)
        .called(fmt::format("primitive {}", primitive))
        .at("primitives")
        .at(primitive);
}

uint64_t vertexCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const auto position = primitive.attributes.find("POSITION");
    return position == primitive.attributes.end() ? 0 : model.accessors[position->second].count;
}

uint64_t triangleCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const uint64_t corners = cornerCount(model, primitive);
    switch (primitive.mode) {
    case TINYGLTF_MODE_TRIANGLES:
        return corners / 3;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return corners < 3 ? 0 : corners - 2;
    default:
        return 0;
    }
}

std::vector<PrimitiveMesh> readMesh(const SourceFile& source, const tinygltf::Model& model, int mesh,
                                    const Scene& scene) {
    const tinygltf::Mesh& from = model.meshes[mesh];
    std::vector<PrimitiveMesh> primitives;
    for (size_t p = 0; p < from.primitives.size(); ++p) {
        const tinygltf::Primitive& primitive = from.primitives[p];
        const Thing owner = primitiveThing(static_cast<size_t>(mesh), from, p);
        if (!primitive.attributes.contains("POSITION"))
            source.note(Severity::Warning, owner.pointer, "MESH_PRIMITIVE_NO_POSITION",
                        owner.name + " is left out: it has no positions");
        else if (primitive.mode < TINYGLTF_MODE_TRIANGLES)
            source.note(Severity::Info, "/meshes", kNotRendered, "points and lines are left out");
        else if (triangleCount(model, primitive) > 0)
            source.attempt(owner, {}, [&] {
                primitives.push_back(PrimitiveReader(source, model, primitive, owner, scene).read());
            });
    }
    return primitives;
}

} // namespace irradia::gltf
