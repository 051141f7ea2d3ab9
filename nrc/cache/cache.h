// A cache of scattered radiance, whatever it learns with (a network, spherical harmonics, probes, nothing):
// it answers the queries of a frame's paths, and learns from the frame's training paths. It knows no
// renderer: who traces paths writes its buffers, laid out as shaders/shared/cache.h says.
//
// A frame: begin(); for each wave of paths beginQueries(), the renderer's tracing, answer(); then learn().
// The frame's predictions come from what the frame before has left.
#pragma once

#include "nrc/learning/trainer.h"
#include "shared/cache.h"
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace irradia {

// What paths bind of a cache, whole; of training paths and vertices a wave binds its range.
struct CacheBuffers {
    BufferRange queries;          // rows for every path of a wave
    BufferRange queryWeights;     // a quad each
    BufferRange counters;         // gpu::kCacheCounters words
    BufferRange trainingPaths;    // of a frame
    BufferRange trainingVertices; // gpu::kMaxTrainingVertices each
    BufferRange trainingQueries;  // a row each
};

// What a renderer wants room for.
struct CacheRoom {
    uint32_t queries = 0;       // of a wave at most
    uint32_t trainingPaths = 0; // of a frame at most
    uint32_t records = 4096;    // of a frame, wanted; half as many again have room, of more some are left out
};

// Of executed frames; what a cache does not count stays 0.
struct CacheCounts {
    uint32_t records = 0;            // of the last frame
    uint32_t skippedRecords = 0;     // of the last frame: there was no room
    uint32_t clampedPredictions = 0; // since the start: were no numbers, and counted as 0
    TrainingCounts training;
    gpu::CacheState state{};
};

class Cache {
public:
    virtual ~Cache() = default;

    virtual CacheBuffers buffers() const = 0;

    virtual void begin(FrameGraph& graph) = 0;
    virtual void beginQueries(FrameGraph& graph) = 0;
    // Adds weight * prediction to radiance[path] (vec4) of every query since beginQueries().
    virtual void answer(FrameGraph& graph, BufferRange radiance) = 0;
    // Learns from `paths` training paths, those from number 0 on.
    virtual void learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& effort) = 0;

    virtual CacheCounts counts() const = 0;
    // What decides its predictions, for the files that are written: name -> text.
    virtual std::map<std::string, std::string> attributes() const { return {}; }
};

// How a cache comes about: `planned` lists the buffers that `make` will allocate, for Device::plan.
struct CacheKind {
    std::function<std::vector<Device::PlannedBuffer>(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                     const CacheRoom& room)>
        planned;
    std::function<std::unique_ptr<Cache>(Device& device, const CacheRoom& room)> make;
};

} // namespace irradia
