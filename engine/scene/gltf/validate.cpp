#include "engine/scene/gltf/validate.h"

#include "engine/scene/gltf/model_check.h"
#include <cmath>

namespace irradia::gltf {
namespace {

class ThingCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    void checkAll(Soundness& sound) const {
        sound.cameras = each(model_.cameras, [&](size_t i) { checkCamera(i); });
        each(model_.skins, [&](size_t i) { checkSkin(i); }); // which are not read
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

    void checkSkin(size_t index) const {
        const tinygltf::Skin& skin = model_.skins[index];
        const Thing owner = thing("skin", "skins", index, skin.name);
        checkIndex(owner.at("inverseBindMatrices"), "accessor", skin.inverseBindMatrices,
                   model_.accessors.size(), Need::Optional);
        checkIndex(owner.at("skeleton"), "node", skin.skeleton, model_.nodes.size(), Need::Optional);
        for (const int joint : skin.joints)
            checkIndex(owner.at("joints"), "node", joint, model_.nodes.size(), Need::Required);
    }
};

} // namespace

Soundness validateModel(const SourceFile& source, const tinygltf::Model& model) {
    Soundness sound;
    sound.data = checkData(source, model);
    sound.materials = checkMaterials(source, model);
    sound.meshes = checkMeshes(source, model);
    ThingCheck(source, model).checkAll(sound);
    sound.lights = checkLights(source, model);
    sound.nodes = checkNodes(source, model);
    return sound;
}

} // namespace irradia::gltf
