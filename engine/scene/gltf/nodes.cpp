#include "engine/scene/gltf/nodes.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace irradia::gltf {
namespace {

glm::dmat4 localTransform(const tinygltf::Node& node) {
    if (!node.matrix.empty()) {
        glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        for (int column = 0; column < 4; ++column) matrix[column].w = column == 3 ? 1.0 : 0.0;
        return matrix;
    }
    glm::dmat4 transform(1.0);
    if (!node.translation.empty())
        transform = glm::translate(transform, glm::make_vec3(node.translation.data()));
    if (const auto& q = node.rotation; !q.empty()) // glTF: x y z w
        transform *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    if (!node.scale.empty()) transform = glm::scale(transform, glm::make_vec3(node.scale.data()));
    return transform;
}

std::vector<int> rootNodes(const tinygltf::Model& model) {
    if (!model.scenes.empty()) return model.scenes[std::max(model.defaultScene, 0)].nodes;
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) isChild[child] = true;
    std::vector<int> roots;
    for (size_t i = 0; i < model.nodes.size(); ++i)
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

// Looks along the node's -Z with +Y up; its scale does not count.
bool orient(Camera& camera, const glm::dmat4& toWorld) {
    const auto forward = -glm::dvec3(toWorld[2]);
    const auto right = glm::cross(forward, glm::dvec3(toWorld[1]));
    const auto position = glm::dvec3(toWorld[3]);
    if (!isFinite(position) || !(glm::length(right) > 0) || !isFinite(right)) return false;
    camera.position = position;
    camera.forward = glm::normalize(forward);
    camera.up = glm::normalize(glm::cross(right, forward));
    return true;
}

} // namespace

bool isFinite(glm::dvec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<Placement> placeNodes(const tinygltf::Model& model) {
    std::vector<Placement> placed;
    for (const int root : rootNodes(model)) placed.push_back({root, localTransform(model.nodes[root])});
    // `placed` is its own queue: hierarchies may be deeper than the stack.
    for (size_t i = 0; i < placed.size(); ++i) {
        const Placement parent = placed[i];
        for (const int child : model.nodes[parent.node].children)
            placed.push_back({child, parent.toWorld * localTransform(model.nodes[child])});
    }
    return placed;
}

std::vector<Camera> placeCameras(const SourceFile& source, const tinygltf::Model& model,
                                 const std::vector<Placement>& nodes) {
    std::vector<Placement> ordered;
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(ordered),
                 [&](const Placement& placement) { return model.nodes[placement.node].camera >= 0; });
    std::sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.node < b.node; });

    std::vector<Camera> cameras;
    for (const Placement& placement : ordered) {
        const tinygltf::Node& node = model.nodes[placement.node];
        const tinygltf::Camera& from = model.cameras[node.camera];
        Camera camera;
        camera.name = from.name.empty() ? node.name : from.name;
        if (from.type == "orthographic")
            camera.halfHeight = static_cast<float>(std::abs(from.orthographic.ymag));
        else
            camera.verticalFov = static_cast<float>(from.perspective.yfov);
        if (!orient(camera, placement.toWorld))
            source.note(Severity::Warning, thing("node", "nodes", placement.node).pointer, {},
                        label("camera", node.camera, camera.name) +
                            " is left out: its node has no orientation");
        else
            cameras.push_back(camera);
    }
    if (cameras.empty() && !model.cameras.empty())
        source.note(Severity::Warning, "/cameras", {},
                    "no camera of the file can be used: the view frames the whole scene");
    return cameras;
}

} // namespace irradia::gltf
