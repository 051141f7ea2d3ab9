#include "engine/scene/gltf_validate.h"

#include "engine/scene/gltf_accessors.h"
#include <cmath>

namespace irradia::gltf {
namespace {

// An accessor without a buffer view is all zeros: only its sparse values are in the file, so the file bounds
// nothing.
constexpr uint64_t kMaxZeroElements = 1ull << 24;

class Validator {
public:
    Validator(const SourceFile& source, const tinygltf::Model& model)
        : source_(source)
        , model_(model) {}

    void checkAll() const {
        for (size_t i = 0; i < model_.bufferViews.size(); ++i) checkBufferView(i);
        for (size_t i = 0; i < model_.accessors.size(); ++i) checkAccessor(i);
        for (size_t i = 0; i < model_.images.size(); ++i) checkImage(i);
        for (size_t i = 0; i < model_.textures.size(); ++i) checkTexture(i);
        for (size_t i = 0; i < model_.samplers.size(); ++i) checkSampler(i);
        for (size_t i = 0; i < model_.materials.size(); ++i) checkMaterial(i);
        for (size_t i = 0; i < model_.meshes.size(); ++i) checkMesh(i);
        for (size_t i = 0; i < model_.cameras.size(); ++i) checkCamera(i);
        for (size_t i = 0; i < model_.skins.size(); ++i) checkSkin(i);
        for (size_t i = 0; i < model_.nodes.size(); ++i) checkNode(i);
        checkGraph();
        checkScenes();
    }

private:
    enum class Need { Required, Optional }; // an absent index is -1

    void checkIndex(const std::string& owner, std::string_view kind, int index, size_t size,
                    Need need) const {
        if (index == -1 && need == Need::Optional) return;
        if (index < 0 || static_cast<size_t>(index) >= size)
            source_.refuse("{}: UNRESOLVED_REFERENCE: {} {} of {}", owner, kind, index, size);
    }

    void checkBufferView(size_t index) const {
        const tinygltf::BufferView& view = model_.bufferViews[index];
        const std::string owner = label("buffer view", index, view.name);
        checkIndex(owner, "buffer", view.buffer, model_.buffers.size(), Need::Required);
        const uint64_t size = model_.buffers[view.buffer].data.size();
        if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
            source_.refuse("{}: BUFFER_VIEW_TOO_LONG: bytes {} + {} of the {} of buffer {}", owner,
                           view.byteOffset, view.byteLength, size, view.buffer);
    }

    // `count` elements of `size` bytes, `stride` apart, from `offset` on, lie in the view.
    void checkRange(const std::string& owner, std::string_view code, int view, uint64_t offset,
                    uint64_t count, uint64_t size, uint64_t stride) const {
        checkIndex(owner, "buffer view", view, model_.bufferViews.size(), Need::Required);
        const uint64_t length = model_.bufferViews[view].byteLength;
        const bool fits = offset <= length && size <= length - offset &&
                          (count == 0 || count - 1 <= (length - offset - size) / stride);
        if (!fits)
            source_.refuse(
                "{}: {}: {} elements of {} bytes, {} apart, from byte {} do not fit the {} bytes of "
                "buffer view {}",
                owner, code, count, size, stride, offset, length, view);
    }

    void checkAccessor(size_t index) const {
        const tinygltf::Accessor& accessor = model_.accessors[index];
        const std::string owner = label("accessor", index, accessor.name);
        if (!isComponentType(accessor.componentType))
            source_.refuse("{}: VALUE_NOT_IN_LIST: component type {}", owner, accessor.componentType);
        if (accessor.count == 0) source_.refuse("{}: VALUE_NOT_IN_RANGE: count 0", owner);
        if (accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
            source_.refuse("{}: ACCESSOR_NORMALIZED_INVALID: component type {}", owner,
                           accessor.componentType);

        if (accessor.bufferView != -1) {
            checkIndex(owner, "buffer view", accessor.bufferView, model_.bufferViews.size(), Need::Required);
            const uint64_t size = elementSize(accessor);
            const uint64_t stride = elementStride(model_, accessor);
            if (stride < size)
                source_.refuse("{}: ACCESSOR_SMALL_BYTESTRIDE: {} for {} bytes", owner, stride, size);
            checkRange(owner, "ACCESSOR_TOO_LONG", accessor.bufferView, accessor.byteOffset, accessor.count,
                       size, stride);
        } else if (accessor.count > kMaxZeroElements) {
            source_.refuse("{}: {} elements without a buffer view are more than the {} allowed", owner,
                           accessor.count, kMaxZeroElements);
        }
        if (accessor.sparse.isSparse) checkSparse(owner, accessor);
    }

    void checkSparse(const std::string& owner, const tinygltf::Accessor& accessor) const {
        const auto& sparse = accessor.sparse;
        const int type = sparse.indices.componentType;
        if (!isIndexType(type)) source_.refuse("{}: VALUE_NOT_IN_LIST: sparse index type {}", owner, type);
        if (sparse.count < 1 || static_cast<uint64_t>(sparse.count) > accessor.count)
            source_.refuse("{}: ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE: {} of {}", owner, sparse.count,
                           accessor.count);
        if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
            source_.refuse("{}: VALUE_NOT_IN_RANGE: negative sparse offset", owner);
        const auto count = static_cast<uint64_t>(sparse.count);
        const uint64_t indexSize = componentSize(type), size = elementSize(accessor);
        checkRange(owner, "ACCESSOR_TOO_LONG (sparse indices)", sparse.indices.bufferView,
                   static_cast<uint64_t>(sparse.indices.byteOffset), count, indexSize, indexSize);
        checkRange(owner, "ACCESSOR_TOO_LONG (sparse values)", sparse.values.bufferView,
                   static_cast<uint64_t>(sparse.values.byteOffset), count, size, size);

        int64_t previous = -1;
        for (uint64_t i = 0; i < count; ++i) {
            const int64_t at = sparseIndex(model_, accessor, i);
            if (at <= previous)
                source_.refuse("{}: ACCESSOR_SPARSE_INDICES_NON_INCREASING: {} after {}", owner, at,
                               previous);
            if (static_cast<uint64_t>(at) >= accessor.count)
                source_.refuse("{}: ACCESSOR_SPARSE_INDEX_OOB: {} of {}", owner, at, accessor.count);
            previous = at;
        }
    }

    void checkImage(size_t index) const {
        const tinygltf::Image& image = model_.images[index];
        checkIndex(label("image", index, image.name), "buffer view", image.bufferView,
                   model_.bufferViews.size(), Need::Optional);
    }

    void checkTexture(size_t index) const {
        const tinygltf::Texture& texture = model_.textures[index];
        const std::string owner = label("texture", index, texture.name);
        checkIndex(owner, "image", texture.source, model_.images.size(), Need::Optional);
        checkIndex(owner, "sampler", texture.sampler, model_.samplers.size(), Need::Optional);
    }

    void checkSampler(size_t index) const {
        const tinygltf::Sampler& sampler = model_.samplers[index];
        for (const int wrap : {sampler.wrapS, sampler.wrapT})
            if (wrap != TINYGLTF_TEXTURE_WRAP_REPEAT && wrap != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE &&
                wrap != TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT)
                source_.refuse("{}: VALUE_NOT_IN_LIST: wrap mode {}", label("sampler", index, sampler.name),
                               wrap);
    }

    void checkMaterial(size_t index) const {
        const tinygltf::Material& material = model_.materials[index];
        const std::string owner = label("material", index, material.name);
        const auto& pbr = material.pbrMetallicRoughness;
        for (const int texture :
             {pbr.baseColorTexture.index, pbr.metallicRoughnessTexture.index, material.normalTexture.index,
              material.occlusionTexture.index, material.emissiveTexture.index})
            checkIndex(owner, "texture", texture, model_.textures.size(), Need::Optional);
        for (const auto& [name, extension] : material.extensions) {
            for (const std::string& key : extension.Keys()) {
                const tinygltf::Value& texture = extension.Get(key);
                if (texture.IsObject() && texture.Has("index"))
                    checkIndex(owner + " " + name, "texture", texture.Get("index").GetNumberAsInt(),
                               model_.textures.size(), Need::Required);
            }
        }
    }

    void checkMesh(size_t index) const {
        const tinygltf::Mesh& mesh = model_.meshes[index];
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            const std::string owner = fmt::format("{} primitive {}", label("mesh", index, mesh.name), p);
            checkIndex(owner, "material", primitive.material, model_.materials.size(), Need::Optional);
            if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
                source_.refuse("{}: VALUE_NOT_IN_LIST: mode {}", owner, primitive.mode);
            checkIndices(owner, primitive);
            for (const auto& [name, accessor] : primitive.attributes)
                checkAttribute(owner, primitive, name, accessor);
            for (const auto& target : primitive.targets)
                for (const auto& [name, accessor] : target) checkAttribute(owner, primitive, name, accessor);
        }
    }

    void checkIndices(const std::string& owner, const tinygltf::Primitive& primitive) const {
        checkIndex(owner, "accessor", primitive.indices, model_.accessors.size(), Need::Optional);
        if (primitive.indices == -1) return;
        const tinygltf::Accessor& accessor = model_.accessors[primitive.indices];
        if (accessor.type != TINYGLTF_TYPE_SCALAR || !isIndexType(accessor.componentType) ||
            accessor.normalized)
            source_.refuse("{}: MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT: accessor {}", owner,
                           primitive.indices);
    }

    void checkAttribute(const std::string& owner, const tinygltf::Primitive& primitive,
                        const std::string& name, int index) const {
        const std::string what = owner + " " + name;
        checkIndex(what, "accessor", index, model_.accessors.size(), Need::Required);
        const tinygltf::Accessor& accessor = model_.accessors[index];
        const bool vec2 = name.starts_with("TEXCOORD_");
        const bool vec3 = name == "POSITION" || name == "NORMAL";
        if ((vec2 && accessor.type != TINYGLTF_TYPE_VEC2) || (vec3 && accessor.type != TINYGLTF_TYPE_VEC3))
            source_.refuse("{}: MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT: accessor {}", what, index);
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) return;
        checkIndex(owner + " POSITION", "accessor", position->second, model_.accessors.size(),
                   Need::Required);
        const uint64_t vertices = model_.accessors[position->second].count;
        if (accessor.count != vertices)
            source_.refuse("{}: MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT: {} for {} positions", what,
                           accessor.count, vertices);
    }

    void checkCamera(size_t index) const {
        const tinygltf::Camera& camera = model_.cameras[index];
        const double fov = camera.perspective.yfov; // radians
        if (camera.type == "perspective" && !(fov > 1e-6 && fov < 3.14159265))
            source_.refuse("{}: VALUE_NOT_IN_RANGE: yfov {}", label("camera", index, camera.name), fov);
    }

    void checkSkin(size_t index) const {
        const tinygltf::Skin& skin = model_.skins[index];
        const std::string owner = label("skin", index, skin.name);
        checkIndex(owner, "accessor", skin.inverseBindMatrices, model_.accessors.size(), Need::Optional);
        checkIndex(owner, "node", skin.skeleton, model_.nodes.size(), Need::Optional);
        for (const int joint : skin.joints)
            checkIndex(owner, "node", joint, model_.nodes.size(), Need::Required);
    }

    void checkNode(size_t index) const {
        const tinygltf::Node& node = model_.nodes[index];
        const std::string owner = label("node", index, node.name);
        checkIndex(owner, "mesh", node.mesh, model_.meshes.size(), Need::Optional);
        checkIndex(owner, "camera", node.camera, model_.cameras.size(), Need::Optional);
        checkIndex(owner, "skin", node.skin, model_.skins.size(), Need::Optional);
        for (const int child : node.children)
            checkIndex(owner, "node", child, model_.nodes.size(), Need::Required);

        const auto checkLength = [&](std::string_view name, size_t length, size_t wanted) {
            if (length != 0 && length != wanted)
                source_.refuse("{}: ARRAY_LENGTH_NOT_IN_LIST: {} of {} numbers, not {}", owner, name, length,
                               wanted);
        };
        checkLength("matrix", node.matrix.size(), 16);
        checkLength("translation", node.translation.size(), 3);
        checkLength("rotation", node.rotation.size(), 4);
        checkLength("scale", node.scale.size(), 3);
        checkTransform(owner, node);
    }

    void checkTransform(const std::string& owner, const tinygltf::Node& node) const {
        if (const auto& m = node.matrix; !m.empty() && !(m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1))
            source_.refuse("{}: NODE_MATRIX_NON_TRS: the last row is not 0 0 0 1", owner);
        if (const auto& q = node.rotation; !q.empty()) {
            const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
            // Exporters round to a few digits; the loader normalises what is nearly a unit.
            if (!(std::abs(length - 1) < 0.01))
                source_.refuse("{}: ROTATION_NON_UNIT: length {}", owner, length);
        }
    }

    // The node hierarchy is a forest: no node has two parents, none is its own ancestor.
    void checkGraph() const {
        constexpr size_t kNone = SIZE_MAX;
        std::vector<size_t> parent(model_.nodes.size(), kNone);
        for (size_t i = 0; i < model_.nodes.size(); ++i)
            for (const int child : model_.nodes[i].children) {
                if (static_cast<size_t>(child) == i) refuseLoop(i);
                if (parent[child] != kNone)
                    source_.refuse("{}: NODE_PARENT_OVERRIDE: child of nodes {} and {}",
                                   label("node", child, model_.nodes[child].name), parent[child], i);
                parent[child] = i;
            }
        std::vector<size_t> visitor(model_.nodes.size(), kNone); // where the walk up came from
        for (size_t start = 0; start < model_.nodes.size(); ++start) {
            size_t i = start;
            for (; i != kNone && visitor[i] == kNone; i = parent[i]) visitor[i] = start;
            if (i != kNone && visitor[i] == start) refuseLoop(i);
        }
        for (size_t s = 0; s < model_.scenes.size(); ++s) checkRoots(s, parent);
    }

    [[noreturn]] void refuseLoop(size_t index) const {
        source_.refuse("{}: NODE_LOOP: it is its own ancestor",
                       label("node", index, model_.nodes[index].name));
    }

    void checkRoots(size_t index, const std::vector<size_t>& parent) const {
        const std::string owner = label("scene", index, model_.scenes[index].name);
        std::vector<bool> listed(model_.nodes.size(), false);
        for (const int root : model_.scenes[index].nodes) {
            checkIndex(owner, "node", root, model_.nodes.size(), Need::Required);
            if (parent[root] != SIZE_MAX)
                source_.refuse("{}: SCENE_NON_ROOT_NODE: node {} has a parent", owner, root);
            if (listed[root]) source_.refuse("{}: DUPLICATE_ELEMENTS: node {}", owner, root);
            listed[root] = true;
        }
    }

    void checkScenes() const {
        checkIndex("the file", "scene", model_.defaultScene, model_.scenes.size(), Need::Optional);
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
};

} // namespace

void validateModel(const SourceFile& source, const tinygltf::Model& model) {
    Validator(source, model).checkAll();
}

} // namespace irradia::gltf
