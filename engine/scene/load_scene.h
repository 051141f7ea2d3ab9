// Reads a glTF 2.0 scene (.gltf or .glb) through tinygltf behind range checks, and the files beside it.
#pragma once

#include "engine/scene/scene.h"
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace irradia {

// Throws Error: NotFound when the file is missing, BadData with one sentence that names the file and the
// thing (accessor, node, extension) that cannot be used. Non-finite and degenerate triangles are dropped and
// counted.
Scene loadScene(const std::filesystem::path& file);

// An environment from "R,G,B" (a constant), or a picture: FILE.hdr, FILE.exr or FILE.exr:LAYER. Warnings
// of what had to be mended go to `notes`. Throws Error as loadScene.
Environment loadEnvironment(const std::string& text, SceneNotes* notes = nullptr);

// A camera file: {"camera": {"position", "look_at", "up", "vfov_deg"}, "env": path | [r,g,b] | null}. What
// stands beside these two is information, as is "aspect" inside "camera"; other keys there are errors.
struct CameraFile {
    Camera camera;
    std::string
        environment; // what loadEnvironment takes, with the path resolved beside the file; empty if none
};
// The camera is placed relative to `origin`, the scene's.
CameraFile loadCameraFile(const std::filesystem::path& file, const glm::dvec3& origin = glm::dvec3(0.0));
// Its object "camera", which stands at `path` of the file that errors name.
Camera parseCamera(const nlohmann::json& camera, const std::string& file, const std::string& path,
                   const glm::dvec3& origin);

// The camera named by --camera: a name, an index or a .json file; empty = the scene's first, else a framing.
CameraFile chooseCamera(const Scene& scene, const std::string& choice);

} // namespace irradia
