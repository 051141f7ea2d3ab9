// A scene in GPU buffers: the quads of shaders/shared/scene.h and the acceleration structure.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/scene/bvh/bvh.h"
#include "engine/scene/packed_scene.h"

namespace irradia {

struct GpuScene {
    Buffer bvh;
    Buffer geometry;
    Buffer attributes;
    Buffer materials;
    Buffer textures;
    Buffer texels;
    Buffer lights;
    Buffer environment;
    Buffer environmentAlias;
    Buffer areaTable; // none unless it was packed
    Buffer reflectanceTable;
    Buffer glassTable; // only for its being there, unless the scene has glass

    SceneNeeds needs;
    glm::dvec3 origin{0.0}; // Scene::origin
    uint32_t triangles = 0;
    uint32_t bvhRoot = 0;    // its item (shared/bvh.h)
    uint32_t lightCount = 0; // local ones
    uint32_t directionalCount = 0;
    uint32_t firstPunctual = 0; // quad of the lights
    LightShares lightShares;
    uint32_t environmentWidth = 1;
    uint32_t environmentHeight = 1;
    PlannedStates states; // that updateScene may bring it to
};

// The bytes uploadScene will allocate, for Device::plan.
std::vector<Device::PlannedBuffer> plannedBuffers(const PackedScene& packed, const Bvh& bvh);

GpuScene uploadScene(Device& device, const PackedScene& packed, const Bvh& bvh);

// Brings a scene on the device to another state of its materials' values (colours, roughness, emission; not
// their textures) and of its environment: lights get their new powers, the needs stay, and so do lights
// without extent. Between graph executions. Geometry, textures and the materials' number are those that were
// uploaded. Throws Error(Internal) where the state is not among those planned for packScene.
void updateScene(Device& device, const Scene& state, GpuScene& scene);

} // namespace irradia
