#include "engine/scene/gpu_scene.h"

#include "engine/error.h"
#include "engine/scene/glass_table.h"
#include "engine/scene/lights/packed_lights.h"
#include "engine/scene/reflectance_table.h"
#include <algorithm>

namespace irradia {

std::vector<Device::PlannedBuffer> plannedBuffers(const PackedScene& packed, const Bvh& bvh) {
    const auto bytes = [](const auto& v) { return uint64_t(v.size() * sizeof(v[0])); };
    return {{"bvh", bytes(bvh.quads)},
            {"geometry", bytes(packed.geometry)},
            {"attributes", bytes(packed.attributes)},
            {"texels", bytes(packed.texels)},
            {"environment", bytes(packed.environment) + bytes(packed.environmentAlias)},
            {"materials and lights", bytes(packed.materials) + bytes(packed.textures) + bytes(packed.lights)},
            {"area table", bytes(packed.areaTable)}};
}

GpuScene uploadScene(Device& device, const PackedScene& packed, const Bvh& bvh) {
    GpuScene scene;
    scene.bvh = makeBuffer(device, "bvh", bvh.quads);
    scene.geometry = makeBuffer(device, "geometry", packed.geometry);
    scene.attributes = makeBuffer(device, "attributes", packed.attributes);
    scene.materials = makeBuffer(device, "materials", packed.materials);
    scene.textures = makeBuffer(device, "textures", packed.textures);
    scene.texels = makeBuffer(device, "texels", packed.texels);
    scene.lights = makeBuffer(device, "lights", packed.lights);
    scene.environment = makeBuffer(device, "environment", packed.environment);
    scene.environmentAlias = makeBuffer(device, "environment alias table", packed.environmentAlias);
    if (!packed.areaTable.empty()) scene.areaTable = makeBuffer(device, "area table", packed.areaTable);
    const std::vector<glm::vec4> reflectances = buildReflectanceTable();
    scene.reflectanceTable = makeBuffer(device, "reflectance table", reflectances);
    scene.glassTable =
        makeBuffer(device, "glass table",
                   packed.needs.glass ? buildGlassTable(reflectances) : std::vector<glm::vec4>(1));
    scene.needs = packed.needs;
    scene.origin = packed.origin;
    scene.triangles = static_cast<uint32_t>(packed.geometry.size() / gpu::kGeometryQuads);
    scene.bvhRoot = bvh.root;
    scene.lightCount = packed.lightCount;
    scene.environmentWidth = std::max(packed.environmentWidth, 1u);
    scene.environmentHeight = std::max(packed.environmentHeight, 1u);
    scene.directionalCount = packed.directionalCount;
    scene.firstPunctual = packed.firstPunctual;
    scene.lightShares = packed.lightShares;
    scene.states = packed.states;
    return scene;
}

namespace {

void requirePlanned(const Scene& state, const GpuScene& scene) {
    PlannedStates all = scene.states;
    all.include(state);
    if (all.emitters != scene.states.emitters || all.environment != scene.states.environment ||
        all.specular != scene.states.specular || all.glass != scene.states.glass)
        fail(ExitCode::Internal, "scene '{}': it was not planned that its {} change so", state.name,
             all.emitters != scene.states.emitters ? "lamps" : "environment or materials");
}

void updateMaterials(Device& device, const Scene& state, GpuScene& scene) {
    auto quads = download<glm::uvec4>(device, scene.materials, state.materials.size() * gpu::kMaterialQuads);
    for (size_t i = 0; i < state.materials.size(); ++i)
        std::ranges::copy(packMaterialValues(state.materials[i]),
                          quads.begin() + static_cast<std::ptrdiff_t>(i * gpu::kMaterialQuads));
    upload<glm::uvec4>(device, scene.materials, quads);
}

} // namespace

void updateScene(Device& device, const Scene& state, GpuScene& scene) {
    requirePlanned(state, scene);
    if (!state.materials.empty()) updateMaterials(device, state, scene);
    const PackedLights lights = packLights(state, scene.states.emitters);
    if (!lights.quads.empty()) upload<glm::uvec4>(device, scene.lights, lights.quads);
    scene.lightShares = lightShares(state, scene.needs);
    if (!scene.needs.environment) return;
    PackedScene packed;
    packEnvironment(state.environment, packed);
    scene.environment = makeBuffer(device, "environment", packed.environment);
    scene.environmentAlias = makeBuffer(device, "environment alias table", packed.environmentAlias);
    scene.environmentWidth = packed.environmentWidth;
    scene.environmentHeight = packed.environmentHeight;
}

} // namespace irradia
