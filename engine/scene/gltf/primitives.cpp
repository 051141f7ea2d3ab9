#include "engine/scene/gltf/primitives.h"

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/tangents.h"
#include "engine/scene/gltf/vertex_reader.h"
#include <optional>

namespace irradia::gltf {
namespace {

constexpr uint32_t kNone = ~0u;
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

class PrimitiveReader {
public:
    PrimitiveReader(const SourceFile& source, const tinygltf::Model& model,
                    const tinygltf::Primitive& primitive, Thing owner, const Scene& scene)
        : source_(source)
        , model_(model)
        , primitive_(primitive)
        , owner_(std::move(owner))
        , material_(scene.materials[materialOf(primitive, scene)])
        , vertices_(source, model, primitive, owner_, material_) {
        mesh_.material = materialOf(primitive, scene);
        noteMissingCoordinates();
    }

    PrimitiveMesh read() {
        const TextureRef& normals = material_.normalTexture;
        const bool generates = normals.image >= 0 && !vertices_.hasTangents();
        slots_.assign(vertices_.count() * 2, kNone);
        for (const glm::uvec3& source : sourceTriangles()) {
            const bool mirrored = generates && isMirrored(source);
            mesh_.triangles.push_back(
                {corner(source.x, mirrored), corner(source.y, mirrored), corner(source.z, mirrored)});
        }
        if (generates) generateTangents(mesh_, normals);
        vertices_.noteMends();
        return std::move(mesh_);
    }

private:
    std::vector<glm::uvec3> sourceTriangles() const {
        const uint64_t count = triangleCount(model_, primitive_);
        if (primitive_.mode == TINYGLTF_MODE_TRIANGLES && cornerCount(model_, primitive_) % 3 != 0)
            source_.note(Severity::Warning, owner_.pointer, "MESH_PRIMITIVE_INCOMPATIBLE_MODE",
                         owner_.name + ": the last indices make no whole triangle and are left out");
        std::optional<AccessorView> indices;
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
        if (index >= vertices_.count())
            source_.refuse(owner_.at("indices"), "ACCESSOR_INDEX_OOB",
                           "accessor {} element {} is {}, there are {} vertices", primitive_.indices, i,
                           index, vertices_.count());
        return index;
    }

    // The vertex for a corner. Sides of a mirrored texture meet in two vertices: their tangents differ. A
    // vertex that takes the flat normal is nobody else's.
    uint32_t corner(uint32_t source, bool mirrored) {
        uint32_t& slot = slots_[2 * uint64_t{source} + (mirrored ? 1 : 0)];
        if (slot != kNone) return slot;
        const Vertex vertex = vertices_.read(source);
        const auto index = static_cast<uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(vertex);
        if (vertex.normal != glm::vec3(0.0f)) slot = index;
        return index;
    }

    bool isMirrored(const glm::uvec3& t) {
        const TextureRef& normals = material_.normalTexture;
        if (!vertices_.hasCoordinates(normals.uvSet)) return false;
        const auto uv = [&](uint32_t i) { return vertices_.coordinates(i, normals); };
        return uvArea(uv(t.x), uv(t.y), uv(t.z)) > 0;
    }

    void noteMissingCoordinates() {
        const Material& m = material_;
        for (const TextureRef* ref :
             {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissiveTexture,
              &m.specularTexture, &m.specularColorTexture, &m.transmissionTexture})
            if (ref->image >= 0 && !vertices_.hasCoordinates(ref->uvSet))
                source_.warn(owner_, "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "its material needs TEXCOORD_{}",
                             ref->uvSet);
    }

    // The file's, or its default material, which is the scene's last.
    static uint32_t materialOf(const tinygltf::Primitive& primitive, const Scene& scene) {
        const int material = primitive.material;
        return static_cast<uint32_t>(material >= 0 ? static_cast<size_t>(material)
                                                   : scene.materials.size() - 1);
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
    const tinygltf::Primitive& primitive_;
    Thing owner_;
    const Material& material_;
    VertexReader vertices_;
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
