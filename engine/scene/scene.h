// A scene as plain data: what the loader produces, the GPU upload and the CPU reference consume.
// World space throughout, less Scene::origin: nodes and instances are already applied. Units are those of the
// file; radiance is W/(sr m^2) as glTF's emissiveFactor x emissiveStrength states it; colours are linear Rec.
// 709.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace irradia {

// An 8-bit picture as stored in the file (sRGB or linear by its use): 4 bytes RGBA a texel, first row = v 0.
struct TextureImage {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba; // width * height * 4
};

enum class Wrap : uint32_t { Repeat = 0, MirroredRepeat = 1, ClampToEdge = 2 };

// A material's use of a picture: bilinear at texel centres (u * width - 1/2), wrapped by texel.
struct TextureRef {
    int image = -1; // index into Scene::images, -1 = none (the factor alone counts)
    int uvSet = 0;  // 0 or 1
    Wrap wrapS = Wrap::Repeat;
    Wrap wrapT = Wrap::Repeat;
    glm::mat3x2 transform{1, 0, 0, 1, 0, 0}; // KHR_texture_transform: uv' = transform * (u, v, 1)
};

// How much of a surface is there, its coverage: all of it, or by `alpha` times the alpha of its texture and
// of its vertices' colour all or nothing of a point (Mask, from alphaCutoff on), or that share (Blend). Light
// passes straight on through the rest.
enum class AlphaMode : uint32_t { Opaque, Mask, Blend };

// glTF 2.0 metallic-roughness with KHR_materials_emissive_strength, _specular, _ior, _transmission, _volume
// and _unlit (Appendix B's terms).
struct Material {
    std::string name;
    glm::vec3 baseColor{1.0f};
    float alpha = 1.0f;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    float metallic = 1.0f;
    float roughness = 1.0f; // perceptual; alpha = roughness^2
    float normalScale = 1.0f;
    glm::vec3 emission{0.0f};       // emissiveFactor * emissiveStrength, radiance
    glm::vec3 emissiveFactor{0.0f}; // as the file has it: emission at strength 1
    float ior = 1.5f;
    float specular = 1.0f;         // KHR_materials_specular, specularFactor
    glm::vec3 specularColor{1.0f}; // KHR_materials_specular, specularColorFactor
    bool doubleSided = false; // false: emits from its front face only; it blocks and scatters on both sides
    bool isUnlit = false; // KHR_materials_unlit: black, two-sided, and its emission (the file's base colour)
                          // is times the vertices' colour
    float transmission = 0.0f;  // KHR_materials_transmission, transmissionFactor
    bool isThin = true;         // a sheet, without an inside: KHR_materials_volume absent, or of thickness 0
    glm::vec3 absorption{0.0f}; // of the inside of what is not thin, per unit of length in the world

    TextureRef baseColorTexture;         // sRGB, times baseColor; A, times alpha
    TextureRef metallicRoughnessTexture; // linear, G times roughness, B times metallic
    TextureRef normalTexture;            // linear, tangent space, xy times normalScale
    TextureRef emissiveTexture;          // sRGB, times emission
    TextureRef specularTexture;          // linear, A times specular
    TextureRef specularColorTexture;     // sRGB, times specularColor
    TextureRef transmissionTexture;      // linear, R times transmission
};

struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  // unit; the flat face normal where the file has none
    glm::vec4 tangent{0.0f}; // unit xyz, w = handedness (bitangent = w * cross(normal, tangent)); 0 if unused
    glm::vec2 uv[2] = {glm::vec2(0.0f), glm::vec2(0.0f)};
    glm::vec4 color{1.0f}; // times the base colour and its alpha, linear, >= 0
};

struct Triangle {
    glm::uvec3 vertex{0}; // indices into Scene::vertices, counter-clockwise seen from the front
    uint32_t material = 0;
};

// Pinhole or orthographic camera; looks along `forward`; aspect comes from the image.
struct Camera {
    std::string name;
    glm::vec3 position{0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f}; // unit
    glm::vec3 up{0.0f, 1.0f, 0.0f};       // unit, orthogonal to forward
    float verticalFov = 0.7f;             // radians, of a pinhole
    float halfHeight = 0.0f;              // of an orthographic view, glTF's ymag; 0 = a pinhole

    bool isOrthographic() const { return halfHeight > 0.0f; }
};

// A light without extent (KHR_lights_punctual).
struct PunctualLight {
    enum class Kind : uint32_t { Point, Spot, Directional };

    std::string name;
    Kind kind = Kind::Point;
    glm::vec3 position{0.0f};               // of points and spots
    glm::vec3 direction{0.0f, 0.0f, -1.0f}; // unit, along which spots and directional lights shine
    glm::vec3 intensity{0.0f}; // W/sr; of directional lights irradiance of what faces them, W/m^2
    // Of points and spots: the distance at which light ends, by the factor max(1 - (distance / range)^4, 0).
    // 0 = none.
    float range = 0.0f;
    // Of spots, radians from the axis: full intensity within the inner angle, none beyond the outer one, and
    // between them the square of what is linear in the cosine.
    float innerAngle = 0.0f;
    float outerAngle = 0.78539816f;
};

// Light from outside: an equirectangular picture (u = atan2(z, x) / 2 pi + 1/2, v = acos(y) / pi, first row =
// +Y, bilinear, wraps in u and clamps in v), or a constant.
struct Environment {
    glm::vec3 constant{0.0f}; // radiance where there is no picture
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> texels; // width * height, radiance; empty = constant

    bool isBlack() const { return texels.empty() && constant == glm::vec3(0.0f); }
};

// What the loader left out or changed, counted; shown to the user.
struct SceneNotes {
    uint64_t nonFiniteTriangles = 0;
    uint64_t degenerateTriangles = 0;
    std::vector<std::string> warnings;
};

struct Scene {
    std::string name;
    glm::dvec3 origin{0.0}; // where the file has position 0 of vertices and cameras
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<Material> materials; // at least one when there are triangles
    std::vector<TextureImage> images;
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;
    Environment environment;
    SceneNotes notes;
    std::vector<std::filesystem::path> files; // that it was read from
    uint64_t contentHash = 0;                 // FNV-1a of the file's bytes, recorded in outputs
};

struct Bounds {
    glm::vec3 lower{0.0f};
    glm::vec3 upper{0.0f};
};

// Box of all triangle corners; the zero box for an empty scene.
Bounds sceneBounds(const Scene& scene);

// The camera that frames the bounds from +Z, slightly above; used when a scene has none.
Camera framingCamera(const Bounds& bounds);

} // namespace irradia
