#include "engine/path/scene_bindings.h"

#include "shared/path.h"

namespace irradia {

KernelOptions fittedTo(const SceneNeeds& needs, uint32_t view) {
    KernelOptions options;
    options.constants = {{gpu::kConstantEnvironment, needs.environment},
                         {gpu::kConstantEmitters, needs.emitters},
                         {gpu::kConstantTextures, needs.textures},
                         {gpu::kConstantSpecular, needs.specular},
                         {gpu::kConstantView, view},
                         {gpu::kConstantLightTree, needs.lightTree}};
    return options;
}

Pass& readSurfaces(Pass& pass, const GpuScene& scene) {
    return pass.read(scene.geometry)
        .read(scene.attributes)
        .read(scene.materials)
        .read(scene.textures)
        .read(scene.texels);
}

Pass& readLights(Pass& pass, const GpuScene& scene) {
    return pass.read(scene.lights).read(scene.environment).read(scene.environmentAlias);
}

} // namespace irradia
