// Writes a self-contained .glb: glTF 2.0 with its geometry and pictures in one binary chunk. Equal calls give
// equal bytes.
#pragma once

#include "engine/image/image.h"
#include "json.h"
#include "mesh.h"

#include <filesystem>
#include <span>
#include <string>

namespace irradia::scenes {

// What the scenes use of glTF's metallic-roughness material and its extensions; the defaults are a dull white
// plastic.
struct GltfMaterial {
    std::string name;
    glm::vec3 baseColor{0.8f};
    float metallic = 0.0f;
    float roughness = 1.0f;
    float specular = 1.0f;    // 0: pure Lambert
    glm::vec3 emission{0.0f}; // radiance, front faces only
    int baseColorTexture = -1;
    int metallicRoughnessTexture = -1; // roughness in green, metallic in blue
    int normalTexture = -1;
    const char* alphaMode = "OPAQUE"; // or "MASK", by the texture's alpha against 1/2, or "BLEND"
    bool doubleSided = false;
    float transmission = 0.0f;
    float ior = 1.5f;
    // Of what is solid; 0: a thin sheet. Over the attenuation's distance light in it fades to that colour.
    float thickness = 0.0f;
    float attenuationDistance = 0.0f; // 0: it does not fade
    glm::vec3 attenuationColor{1.0f};
};

// A light without extent (KHR_lights_punctual), a point but for its cone.
struct GltfLight {
    glm::vec3 color{1.0f};
    float intensity = 1.0f; // W/sr; of the sun W/m^2 on what faces it
    glm::vec2 cone{0.0f};   // of a spot, inner and outer angle in radians
    bool isSun = false;     // at infinity
};

class GlbWriter {
public:
    // A picture repeated in both directions, as PNG. Returns the texture's index.
    int addTexture(const std::string& name, const Rgba8Image& image);
    int addMaterial(const GltfMaterial& material);

    struct Part {
        const Mesh* mesh;
        int material;
    };
    int addMesh(const std::string& name, std::span<const Part> parts);
    int addMesh(const std::string& name, const Mesh& mesh, int material);

    void addNode(const std::string& name, int mesh, const glm::mat4& transform = glm::mat4(1.0f));

    // Shorthand for a mesh that stands in one place.
    void add(const std::string& name, const Mesh& mesh, int material,
             const glm::mat4& transform = glm::mat4(1.0f));

    int addLight(const GltfLight& light);
    // Spots and the sun shine along their node's -z.
    void addLightNode(const std::string& name, int light, const glm::mat4& transform);

    void addCamera(const std::string& name, glm::vec3 eye, glm::vec3 target, float verticalFovDegrees);

    // A lamp at infinity that shines along a direction; its irradiance is that of what faces it.
    void addSun(const std::string& name, glm::vec3 direction, glm::vec3 irradiance);

    void write(const std::filesystem::path& file) const;

private:
    int addView(std::span<const uint8_t> bytes);
    template <typename T>
    int addAccessor(const std::vector<T>& values, int componentType, const char* type);
    void placeNode(const std::string& name, const glm::mat4& transform, const char* kind, Json what);
    void useExtension(const char* name);
    // The extension's object of a material, which then has it.
    Json& extend(Json& material, const char* name);

    Json gltf_ = {{"asset", {{"version", "2.0"}, {"generator", "Irradia make_scenes"}}}};
    std::vector<uint8_t> binary_;
};

} // namespace irradia::scenes
