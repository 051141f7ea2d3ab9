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
    const auto& [t, r, s] = std::tie(node.translation, node.rotation, node.scale);
    return transformOf(t.empty() ? glm::dvec3(0.0) : glm::make_vec3(t.data()),
                       r.empty() ? glm::dvec4(0, 0, 0, 1) : glm::make_vec4(r.data()),
                       s.empty() ? glm::dvec3(1.0) : glm::make_vec3(s.data()));
}

// Those that are no node's child.
std::vector<int> allRoots(const tinygltf::Model& model) {
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) isChild[child] = true;
    std::vector<int> roots;
    for (size_t i = 0; i < model.nodes.size(); ++i)
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

std::vector<Placement> placeFrom(const tinygltf::Model& model, const std::vector<int>& roots) {
    std::vector<Placement> placed;
    for (const int root : roots) placed.push_back({root, localTransform(model.nodes[root])});
    // `placed` is its own queue: hierarchies may be deeper than the stack.
    for (size_t i = 0; i < placed.size(); ++i) {
        const Placement parent = placed[i];
        for (const int child : model.nodes[parent.node].children)
            placed.push_back({child, parent.toWorld * localTransform(model.nodes[child])});
    }
    return placed;
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

glm::dmat4 transformOf(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
    const glm::dquat q(rotation.w, rotation.x, rotation.y, rotation.z);
    return glm::scale(glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(glm::normalize(q)),
                      scale);
}

std::vector<Placement> placeNodes(const tinygltf::Model& model) {
    return placeFrom(model, model.scenes.empty() ? allRoots(model)
                                                 : model.scenes[std::max(model.defaultScene, 0)].nodes);
}

std::vector<glm::dmat4> worldTransforms(const tinygltf::Model& model) {
    std::vector<glm::dmat4> worlds(model.nodes.size());
    for (const Placement& placement : placeFrom(model, allRoots(model)))
        worlds[placement.node] = placement.toWorld;
    return worlds;
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
