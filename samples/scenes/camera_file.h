// The file beside a scene that says from where it is seen and what light comes from outside: glTF has no
// environment.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

namespace irradia::scenes {

struct View {
    glm::vec3 eye, target;
    float verticalFovDegrees;
};

// Under the sky of a picture beside the file.
void writeCameraFile(const std::filesystem::path& file, const View& view, const std::string& sky);
// Under an even sky of that radiance.
void writeCameraFile(const std::filesystem::path& file, const View& view, glm::vec3 sky);

} // namespace irradia::scenes
