// A Scene packed into the quads of shaders/shared/scene.h; no GPU involved.
#pragma once

#include "engine/scene/scene.h"
#include "shared/scene.h"
#include <array>
#include <string>
#include <vector>

namespace irradia {

// What a scene needs of the path tracer's kernels: code for the rest is not compiled.
struct SceneNeeds {
    bool environment = false; // light from outside
    bool emitters = false;    // emissive triangles
    uint32_t punctual = 0;    // mask of gpu::kPunctualLocal, ...
    bool lightTree = false;   // so many local lights that a hierarchy chooses among them
    uint32_t textures = 0;    // mask of gpu::kBaseColorTexture, ..., and of vertex attributes
    bool specular = false;
    bool transparency = false; // some surface lets light straight on through, or has an inside
    bool glass = false;        // some surface scatters what it transmits
};

// States that a scene on a device will take (its geometry and pictures stay as they are): so that its lights
// and kernels have room for all of them. Include each state; that which is packed counts by itself.
struct PlannedStates {
    std::vector<bool> emitters; // a material that emits in some state; empty = none
    bool environment = false;   // light from outside in some state
    bool specular = false;
    bool glass = false;

    void include(const Scene& state);
};

// Of light samples, by group: what goes to the environment, to directional lights, and to local ones
// (emissive triangles, points and spots).
struct LightShares {
    float environment = 0.0f, directional = 0.0f, local = 0.0f;
};

struct PackedScene {
    std::vector<glm::uvec4> geometry;
    std::vector<glm::uvec4> attributes; // empty in scenes without textures
    std::vector<glm::uvec4> materials;
    std::vector<glm::uvec4> textures;
    std::vector<glm::uvec2> texels; // four halves each
    std::vector<glm::uvec4> lights;
    std::vector<glm::uvec4> environment;
    std::vector<glm::uvec4> environmentAlias;
    std::vector<glm::uvec4> areaTable; // empty unless packAreaTable has added it
    uint32_t lightCount = 0;           // local lights, the first of `lights`; a hierarchy's nodes follow them
    uint32_t directionalCount = 0;
    uint32_t firstPunctual = 0; // quad of `lights`
    LightShares lightShares;
    uint32_t environmentWidth = 0;
    uint32_t environmentHeight = 0;
    SceneNeeds needs;
    glm::dvec3 origin{0.0};            // the scene's
    PlannedStates states;              // this one among them
    std::vector<std::string> warnings; // pictures that were made smaller to fit, and what will surprise
};

// Most bytes one binding may hold (lavapipe's limit on storage buffers).
inline constexpr uint64_t kMaxBindingBytes = 128ull << 20;

// Throws Error(OutOfMemory) naming the part that does not fit one binding.
PackedScene packScene(const Scene& scene, const PlannedStates& states = {});

// Octahedral map of a unit vector (Cigolle et al. 2014); of a vector without direction gpu::kNoTangent.
uint32_t packOctahedral(const glm::vec3& n);

// The first quads of a material: what may change while it is rendered.
inline constexpr uint32_t kMaterialValueQuads = 4;
std::array<glm::uvec4, kMaterialValueQuads> packMaterialValues(const Material& material);

} // namespace irradia
