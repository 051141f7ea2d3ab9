// A scene in GPU buffers: the records of shaders/shared/scene.h and the acceleration structure.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/scene/bvh.h"
#include "engine/scene/scene_records.h"

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
    Buffer reflectanceTable;

    SceneNeeds needs;
    uint32_t triangles = 0;
    uint32_t bvhRoot = 0; // record index
    uint32_t lightCount = 0;
    uint32_t environmentWidth = 1;
    uint32_t environmentHeight = 1;
    float environmentProbability = 0.0f; // of a light sample going to the environment
    float rayEpsilon = 0.0f;             // length by which ray origins leave their surface
};

// Ray origins leave their surface by this share of the scene's largest coordinate.
inline constexpr float kRayEpsilonShare = 1e-5f;
float rayEpsilon(const Bounds& bounds);

// The bytes uploadScene will allocate, for Device::plan.
std::vector<Device::PlannedBuffer> plannedBuffers(const SceneRecords& records, const Bvh& bvh);

GpuScene uploadScene(Device& device, const SceneRecords& records, const Bvh& bvh, const Bounds& bounds);

} // namespace irradia
