// What a glTF file holds, rendered or not: for those who want to know before they render it.
#pragma once

#include "engine/scene/scene.h"
#include <filesystem>
#include <string>
#include <vector>

namespace irradia {

struct ExtensionFact {
    std::string name;
    std::string support; // "rendered", "ignored" or "unknown"
    bool isRequired = false;
    std::string consequence; // of an ignored one, "such materials are opaque"
};

struct PictureFact {
    std::string name;
    int width = 0, height = 0;
};

struct SceneFacts {
    std::string format; // "glb" or "gltf"
    std::string version, generator;
    uint64_t bytes = 0; // of the file itself

    uint64_t triangles = 0, vertices = 0;                     // as placed by instances
    uint64_t nonFiniteTriangles = 0, degenerateTriangles = 0; // left out of these
    uint64_t meshes = 0, primitives = 0, instances = 0, nodes = 0, scenes = 0, materials = 0;
    uint64_t maskedMaterials = 0, blendedMaterials = 0; // by their alpha mode
    uint64_t transmissiveMaterials = 0, unlitMaterials = 0;
    uint64_t colouredPrimitives = 0; // with colours of their vertices
    uint64_t textures = 0, pictures = 0;
    std::vector<PictureFact> usedPictures; // by materials, decoded
    uint64_t texels = 0;                   // of these

    uint64_t emissiveTriangles = 0, emissiveMaterials = 0;
    uint64_t pointLights = 0, spotLights = 0, directionalLights = 0; // that stand in the scene and shine
    uint64_t extensionLights = 0;      // of EXT_lights_image_based, not rendered
    std::vector<Camera> cameras;       // that stand in the scene, where the file has them
    glm::dvec3 lower{0.0}, upper{0.0}; // of all triangles, where the file has them

    std::vector<ExtensionFact> extensions;
    uint64_t animations = 0, skins = 0, morphTargets = 0; // not rendered
    std::vector<std::string> warnings;
};

// Throws what loadScene throws.
SceneFacts readSceneFacts(const std::filesystem::path& file);

} // namespace irradia
