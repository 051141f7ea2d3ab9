#include "engine/path/scene_bindings.h"

namespace irradia {

KernelOptions fittedTo(const SceneNeeds& needs, const PathTracerOptions& options) {
    KernelOptions fitted;
    fitted.constants = {{gpu::kConstantEnvironment, needs.environment},
                        {gpu::kConstantEmitters, needs.emitters},
                        {gpu::kConstantTextures, needs.textures},
                        {gpu::kConstantSpecular, needs.specular},
                        {gpu::kConstantView, options.view},
                        {gpu::kConstantLightTree, needs.lightTree},
                        {gpu::kConstantSampler, options.sampler},
                        {gpu::kConstantTransparency, needs.transparency},
                        {gpu::kConstantGlass, needs.glass},
                        {gpu::kConstantPunctual, needs.punctual}};
    return fitted;
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
