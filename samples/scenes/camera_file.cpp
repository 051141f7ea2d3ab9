#include "camera_file.h"

#include "engine/image/image.h"
#include "json.h"

namespace irradia::scenes {

static Json numbers(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

static void write(const std::filesystem::path& file, const View& view, const Json& environment) {
    const Json json = {{"camera",
                        {{"position", numbers(view.eye)},
                         {"look_at", numbers(view.target)},
                         {"up", {0.0f, 1.0f, 0.0f}},
                         {"vfov_deg", view.verticalFovDegrees}}},
                       {"env", environment}};
    const std::string text = json.dump(2) + "\n";
    writeFileAtomically(file, std::vector<uint8_t>(text.begin(), text.end()));
}

void writeCameraFile(const std::filesystem::path& file, const View& view, const std::string& sky) {
    write(file, view, sky);
}

void writeCameraFile(const std::filesystem::path& file, const View& view, glm::vec3 sky) {
    write(file, view, numbers(sky));
}

} // namespace irradia::scenes
