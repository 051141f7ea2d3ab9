#include "engine/scene/gpu_scene.h"

#include "engine/error.h"
#include "engine/scene/lights/light_records.h"
#include "engine/scene/reflectance_table.h"
#include <algorithm>

namespace irradia {

std::vector<Device::PlannedBuffer> plannedBuffers(const SceneRecords& records, const Bvh& bvh) {
    const auto bytes = [](const auto& v) { return uint64_t(v.size() * sizeof(v[0])); };
    return {
        {"bvh", bytes(bvh.records)},
        {"geometry", bytes(records.geometry)},
        {"attributes", bytes(records.attributes)},
        {"texels", bytes(records.texels)},
        {"environment", bytes(records.environment) + bytes(records.environmentAlias)},
        {"materials and lights", bytes(records.materials) + bytes(records.textures) + bytes(records.lights)},
        {"area table", bytes(records.areaTable)}};
}

GpuScene uploadScene(Device& device, const SceneRecords& records, const Bvh& bvh) {
    GpuScene scene;
    scene.bvh = makeBuffer(device, "bvh", bvh.records);
    scene.geometry = makeBuffer(device, "geometry", records.geometry);
    scene.attributes = makeBuffer(device, "attributes", records.attributes);
    scene.materials = makeBuffer(device, "materials", records.materials);
    scene.textures = makeBuffer(device, "textures", records.textures);
    scene.texels = makeBuffer(device, "texels", records.texels);
    scene.lights = makeBuffer(device, "lights", records.lights);
    scene.environment = makeBuffer(device, "environment", records.environment);
    scene.environmentAlias = makeBuffer(device, "environment alias table", records.environmentAlias);
    if (!records.areaTable.empty()) scene.areaTable = makeBuffer(device, "area table", records.areaTable);
    scene.reflectanceTable = makeBuffer(device, "reflectance table", buildReflectanceTable());
    scene.needs = records.needs;
    scene.origin = records.origin;
    scene.triangles = static_cast<uint32_t>(records.geometry.size() / gpu::kGeometryRecords);
    scene.bvhRoot = bvh.root;
    scene.lightCount = records.lightCount;
    scene.environmentWidth = std::max(records.environmentWidth, 1u);
    scene.environmentHeight = std::max(records.environmentHeight, 1u);
    scene.environmentProbability = records.environmentProbability;
    scene.states = records.states;
    return scene;
}

namespace {

void requirePlanned(const Scene& state, const GpuScene& scene) {
    PlannedStates all = scene.states;
    all.include(state);
    if (all.emitters != scene.states.emitters || all.environment != scene.states.environment ||
        all.specular != scene.states.specular)
        fail(ExitCode::Internal, "scene '{}': it was not planned that its {} change so", state.name,
             all.emitters != scene.states.emitters ? "lamps" : "environment or materials");
}

void updateMaterials(Device& device, const Scene& state, GpuScene& scene) {
    auto records =
        download<glm::uvec4>(device, scene.materials, state.materials.size() * gpu::kMaterialRecords);
    for (size_t i = 0; i < state.materials.size(); ++i)
        std::ranges::copy(packMaterialValues(state.materials[i]),
                          records.begin() + static_cast<std::ptrdiff_t>(i * gpu::kMaterialRecords));
    upload<glm::uvec4>(device, scene.materials, records);
}

} // namespace

void updateScene(Device& device, const Scene& state, GpuScene& scene) {
    requirePlanned(state, scene);
    if (!state.materials.empty()) updateMaterials(device, state, scene);
    const LightRecords lights = packLights(state, scene.states.emitters);
    if (lights.count > 0) upload<glm::uvec4>(device, scene.lights, lights.records);
    scene.environmentProbability = environmentProbability(state, scene.needs);
    if (!scene.needs.environment) return;
    SceneRecords records;
    packEnvironment(state.environment, records);
    scene.environment = makeBuffer(device, "environment", records.environment);
    scene.environmentAlias = makeBuffer(device, "environment alias table", records.environmentAlias);
    scene.environmentWidth = records.environmentWidth;
    scene.environmentHeight = records.environmentHeight;
}

} // namespace irradia
