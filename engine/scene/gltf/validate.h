// Every index and every range of a model, checked in 64 bits before anything is read through it. Errors carry
// the codes of Khronos' glTF validator.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"

namespace irradia::gltf {

// What has passed, and may be read; all of it where errors are thrown.
struct Soundness {
    bool data = false;      // buffer views and accessors
    bool materials = false; // with their textures
    bool meshes = false;
    bool nodes = false;
    bool cameras = false;
    bool lights = false;
};

// Checks buffer views, accessors, meshes, materials, textures, images, cameras, skins, lights, nodes and
// scenes. Throws BadData at the first fault, or collects one for each thing.
Soundness validateModel(const SourceFile& source, const tinygltf::Model& model);

} // namespace irradia::gltf
