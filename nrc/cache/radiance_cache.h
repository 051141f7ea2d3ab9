// The neural radiance cache (Müller 2021): answers queries of a frame's paths, and learns from the frame's
// training paths. It knows no renderer: who traces paths writes the buffers named here, laid out as
// shaders/shared/cache.h says.
//
// A frame: begin(); for each wave of paths beginQueries(), the renderer's tracing, answer(); then learn().
// The frame's predictions come from the weights that the frame before has left.
#pragma once

#include "nrc/learning/trainer.h"
#include "shared/cache.h"

namespace irradia {

struct CacheOptions {
    ModelConfig model;          // gpu::kCacheInputs inputs, gpu::kCacheOutputs outputs
    uint32_t queries = 0;       // of a wave at most
    uint32_t trainingPaths = 0; // of a frame at most
    uint32_t records = 4096;    // of a frame, wanted; half as many again have room, and more are left out
    uint32_t steps = 4;         // of optimisation a frame
    bool factorise = true;      // what is learned is multiplied by the reflectance alpha + beta
    Weights selfTraining = Weights::Ema; // whose predictions end the training paths
    float meanDecay = 0.95f;             // of the running mean of the targets' brightness, a frame
    uint64_t seed = 1;
    std::vector<glm::vec3> touched; // as TrainerOptions'
};

// Of executed frames.
struct CacheCounts {
    uint32_t records = 0;            // of the last frame
    uint32_t skippedRecords = 0;     // of the last frame: there was no room
    uint32_t clampedPredictions = 0; // since the start: were no numbers, and counted as 0
    TrainingCounts training;
    gpu::CacheState state;
};

class RadianceCache {
public:
    RadianceCache(Device& device, const CacheOptions& options);
    ~RadianceCache();

    // What the constructor will allocate, the trainer's buffers with it, for Device::plan.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                      const CacheOptions& options);

    const CacheOptions& options() const;
    Trainer& trainer();

    // The renderer's to fill, after begin() and beginQueries().
    BufferRange queries() const;
    BufferRange queryWeights() const;
    BufferRange counters() const;
    const Buffer& trainingPaths() const; // of which, as of the vertices, a wave binds its range
    const Buffer& trainingVertices() const;
    BufferRange trainingQueries() const;

    void begin(FrameGraph& graph);
    void beginQueries(FrameGraph& graph);
    // Adds weight * prediction to radiance[path] (vec4) of every query since beginQueries().
    // `reflectance` false: of a cache that factorises, what the network itself predicts.
    void answer(FrameGraph& graph, BufferRange radiance, Weights weights = Weights::Ema,
                bool reflectance = true);
    // Learns from `paths` training paths, those from number 0 on.
    void learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& effort = {});

    CacheCounts counts() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace irradia
