// Changes of a scene by frame, as a JSON list; an entry names its frame and any of
//
//     {"frame": 100,
//      "emissive_strength": {"material": "lamp" or its index, "value": 0},
//      "material": {"name": "wall" or its index, "base_color": [r, g, b], "roughness": x, "metallic": x},
//      "environment": [r, g, b], or a factor of the environment that the scene started with,
//      "camera": what a camera file holds under this name,
//      "restart": true}
//
// Frames are numbered as by --frames A-B. What an entry does not name stays; a change lasts until another, so
// that frame A shows all changes up to A; warm-up sees the scene of frame A. "restart": the film begins anew
// with this frame, what was learned stays.
#pragma once

#include "engine/scene/packed_scene.h"
#include "engine/scene/scene.h"
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

namespace irradia {

struct SceneChange {
    struct Strength {
        size_t material = 0;
        float value = 0; // of KHR_materials_emissive_strength
    };
    struct Surface {
        size_t material = 0;
        std::optional<glm::vec3> baseColor;
        std::optional<float> roughness, metallic;
    };

    size_t entry = 0; // of the file's list
    uint32_t frame = 0;
    std::optional<Strength> strength;
    std::optional<Surface> surface;
    std::optional<Environment> environment;
    std::optional<Camera> camera;
    bool restart = false;

    bool changesScene() const { return strength || surface || environment; }
    void applyTo(Scene& scene) const;
};

class ScriptedChanges {
public:
    ScriptedChanges() = default;
    // Throws Error: NotFound; BadData naming the file and what cannot be used.
    ScriptedChanges(const std::filesystem::path& file, const Scene& scene);

    // Everything that the scene will be.
    PlannedStates states(const Scene& scene) const;
    // Throws Error(BadData) naming the first change that would never come.
    void requireBefore(uint32_t endFrame) const;
    // The changes up to this frame that were not taken before, by frame and then in the file's order.
    std::span<const SceneChange> takeUpTo(uint32_t frame);

private:
    std::string file_;
    std::vector<SceneChange> changes_;
    size_t taken_ = 0;
};

} // namespace irradia
