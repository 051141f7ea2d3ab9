// A glTF primitive as triangles in its mesh's own space, before any node places it.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/gltf/pose.h"
#include "engine/scene/scene.h"
#include <vector>

namespace irradia::gltf {

// Only vertices that triangles use, as the file states them: nothing is unit length or finite yet. A zero
// normal stands for the flat one; such a vertex belongs to one triangle.
struct PrimitiveMesh {
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles;
    uint32_t material = 0;
};

// "mesh 2 'cup' primitive 0"
Thing primitiveThing(size_t index, const tinygltf::Mesh& mesh, size_t primitive);

// Vertices a primitive names, used or not.
uint64_t vertexCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

// Triangles a primitive will have: 0 for points and lines.
uint64_t triangleCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

// Every triangle primitive of a mesh in that pose; the model has passed validateModel. Throws BadData for an
// index out of range.
std::vector<PrimitiveMesh> readMesh(const SourceFile& source, const tinygltf::Model& model, int mesh,
                                    const Pose& pose, const Scene& scene);

} // namespace irradia::gltf
