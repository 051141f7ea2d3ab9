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

    bool checkAll() const {
        bool isGood = true, isGraph = true;
        for (size_t i = 0; i < model_.nodes.size(); ++i) {
            isGraph = attempt([&] { checkChildren(i); }) && isGraph;
            isGood = attempt([&] { checkNode(i); }) && isGood;
        }
        if (isGraph) isGraph = checkGraph();
        isGood = attempt([&] {
                     checkIndex({"the file", "/scene"}, "scene", model_.defaultScene, model_.scenes.size(),
                                Need::Optional);
                 }) &&
                 isGood;
        return isGood && isGraph;
    }

private:
    Thing nodeThing(size_t index) const { return thing("node", "nodes", index, model_.nodes[index].name); }

    void checkChildren(size_t index) const {
        const std::vector<int>& children = model_.nodes[index].children;
        const Thing owner = nodeThing(index).at("children");
        for (size_t i = 0; i < children.size(); ++i)
            checkIndex(owner.at(i), "node", children[i], model_.nodes.size(), Need::Required);
    }

    void checkNode(size_t index) const {
        const tinygltf::Node& node = model_.nodes[index];
        const Thing owner = nodeThing(index);
        checkIndex(owner.at("mesh"), "mesh", node.mesh, model_.meshes.size(), Need::Optional);
        checkIndex(owner.at("camera"), "camera", node.camera, model_.cameras.size(), Need::Optional);
        checkIndex(owner.at("skin"), "skin", node.skin, model_.skins.size(), Need::Optional);

        const auto checkLength = [&](std::string_view name, size_t length, size_t wanted) {
            if (length != 0 && length != wanted)
                source_.refuse(owner.at(name), "ARRAY_LENGTH_NOT_IN_LIST", "{} of {} numbers, not {}", name,
                               length, wanted);
        };
        checkLength("matrix", node.matrix.size(), 16);
        checkLength("translation", node.translation.size(), 3);
        checkLength("rotation", node.rotation.size(), 4);
        checkLength("scale", node.scale.size(), 3);
        checkTransform(owner, node);
    }

    void checkTransform(const Thing& owner, const tinygltf::Node& node) const {
        if (const auto& m = node.matrix; !m.empty() && !isAffine(m))
            source_.refuse(owner.at("matrix"), "NODE_MATRIX_NON_TRS", "the last row is not 0 0 0 1");
        if (const auto& q = node.rotation; !q.empty()) {
            const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
            // Exporters round to a few digits; the loader normalises what is nearly a unit.
            if (!(std::abs(length - 1) < 0.01))
                source_.refuse(owner.at("rotation"), "ROTATION_NON_UNIT", "length {}", length);
        }
    }

    // The node hierarchy is a forest: no node has two parents, none is its own ancestor.
    bool checkGraph() const {
        bool isGood = true;
        std::vector<size_t> parent(model_.nodes.size(), kNone);
        for (size_t i = 0; i < model_.nodes.size(); ++i)
            isGood = attempt([&] { adopt(i, parent); }) && isGood;
        isGood = attempt([&] { checkLoops(parent); }) && isGood;
        std::vector<size_t> listedBy(model_.nodes.size(), kNone); // the last scene that named a node
        for (size_t s = 0; s < model_.scenes.size(); ++s)
            isGood = attempt([&] { checkRoots(s, parent, listedBy); }) && isGood;
        return isGood;
    }

    void adopt(size_t index, std::vector<size_t>& parent) const {
        for (const int child : model_.nodes[index].children) {
            if (static_cast<size_t>(child) == index) refuseLoop(index);
            if (parent[child] != kNone)
                source_.refuse(nodeThing(static_cast<size_t>(child)), "NODE_PARENT_OVERRIDE",
                               "child of nodes {} and {}", parent[child], index);
            parent[child] = index;
        }
    }

    void checkLoops(const std::vector<size_t>& parent) const {
        std::vector<size_t> visitor(model_.nodes.size(), kNone); // where the walk up came from
        for (size_t start = 0; start < model_.nodes.size(); ++start) {
            size_t i = start;
            for (; i != kNone && visitor[i] == kNone; i = parent[i]) visitor[i] = start;
            if (i != kNone && visitor[i] == start) refuseLoop(i);
        }
    }

    [[noreturn]] void refuseLoop(size_t index) const {
        source_.refuse(nodeThing(index), "NODE_LOOP", "it is its own ancestor");
    }

    void checkRoots(size_t index, const std::vector<size_t>& parent, std::vector<size_t>& listedBy) const {
        const Thing owner = thing("scene", "scenes", index, model_.scenes[index].name).at("nodes");
        for (const int root : model_.scenes[index].nodes) {
            checkIndex(owner, "node", root, model_.nodes.size(), Need::Required);
            if (parent[root] != kNone)
                source_.refuse(owner, "SCENE_NON_ROOT_NODE", "node {} has a parent", root);
            if (listedBy[root] == index) source_.refuse(owner, "DUPLICATE_ELEMENTS", "node {}", root);
            listedBy[root] = index;
        }
    }
};

} // namespace

bool checkNodes(const SourceFile& source, const tinygltf::Model& model) {
    return NodeCheck(source, model).checkAll();
}

} // namespace irradia::gltf
