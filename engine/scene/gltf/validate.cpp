#include "engine/scene/gltf/validate.h"

#include "engine/scene/gltf/model_check.h"
#include <cmath>

namespace irradia::gltf {
namespace {

class CameraCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    bool checkAll() const {
        return each(model_.cameras, [&](size_t i) { checkCamera(i); });
    }

private:
    void checkCamera(size_t index) const {
        const tinygltf::Camera& camera = model_.cameras[index];
        const Thing owner = thing("camera", "cameras", index, camera.name);
        const double fov = camera.perspective.yfov; // radians
        const double height = std::abs(camera.orthographic.ymag);
        if (camera.type == "orthographic" && !(height > 1e-30 && height < 1e30))
            source_.refuse(owner.at("orthographic").at("ymag"), "VALUE_NOT_IN_RANGE", "ymag {}",
                           camera.orthographic.ymag);
        if (camera.type == "perspective" && !(fov > 1e-6 && fov < 3.14159265))
            source_.refuse(owner.at("perspective").at("yfov"), "VALUE_NOT_IN_RANGE", "yfov {}", fov);
    }
};

} // namespace

Soundness validateModel(const SourceFile& source, const tinygltf::Model& model) {
    Soundness sound;
    sound.data = checkData(source, model);
    sound.materials = checkMaterials(source, model);
    sound.meshes = checkMeshes(source, model);
    sound.cameras = CameraCheck(source, model).checkAll();
    sound.skins = checkSkins(source, model);
    sound.lights = checkLights(source, model);
    sound.nodes = checkNodes(source, model);
    sound.nodes = checkInstancing(source, model) && sound.nodes;
    return sound;
}

} // namespace irradia::gltf
