#include "engine/scene/gltf/model_check.h"

#include <cmath>
#include <cstdint>

namespace irradia::gltf {
namespace {

constexpr size_t kNone = SIZE_MAX;

// The last row is 0 0 0 1 but for what exporters round; the loader takes it as exact.
bool isAffine(const std::vector<double>& m) {
    constexpr double kRounding = 1e-4;
    return std::abs(m[3]) <= kRounding && std::abs(m[7]) <= kRounding && std::abs(m[11]) <= kRounding &&
           std::abs(m[15] - 1) <= kRounding;
}

class NodeCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    void checkAll() const {
        for (size_t i = 0; i < model_.nodes.size(); ++i) checkNode(i);
        checkGraph();
        checkIndex("the file", "scene", model_.defaultScene, model_.scenes.size(), Need::Optional);
    }

private:
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
        if (const auto& m = node.matrix; !m.empty() && !isAffine(m))
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
        std::vector<size_t> listedBy(model_.nodes.size(), kNone); // the last scene that named a node
        for (size_t s = 0; s < model_.scenes.size(); ++s) checkRoots(s, parent, listedBy);
    }

    [[noreturn]] void refuseLoop(size_t index) const {
        source_.refuse("{}: NODE_LOOP: it is its own ancestor",
                       label("node", index, model_.nodes[index].name));
    }

    void checkRoots(size_t index, const std::vector<size_t>& parent, std::vector<size_t>& listedBy) const {
        const std::string owner = label("scene", index, model_.scenes[index].name);
        for (const int root : model_.scenes[index].nodes) {
            checkIndex(owner, "node", root, model_.nodes.size(), Need::Required);
            if (parent[root] != kNone)
                source_.refuse("{}: SCENE_NON_ROOT_NODE: node {} has a parent", owner, root);
            if (listedBy[root] == index) source_.refuse("{}: DUPLICATE_ELEMENTS: node {}", owner, root);
            listedBy[root] = index;
        }
    }
};

} // namespace

void checkNodes(const SourceFile& source, const tinygltf::Model& model) {
    NodeCheck(source, model).checkAll();
}

} // namespace irradia::gltf
