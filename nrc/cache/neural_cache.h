// The neural radiance cache (Müller 2021): a network that says how much light a place scatters.
#pragma once

#include "nrc/cache/cache.h"

namespace irradia {

struct NeuralCacheOptions {
    ModelConfig model;                   // gpu::kCacheInputs inputs, gpu::kCacheOutputs outputs
    uint32_t steps = 4;                  // of optimisation a frame
    bool factorise = true;               // what is learned is multiplied by the reflectance alpha + beta
    Weights selfTraining = Weights::Ema; // whose predictions end the training paths
    Weights shown = Weights::Ema;        // whose predictions answer the queries
    bool showReflectance = true; // false: of a cache that factorises, they show what the network itself says
    float meanDecay = 0.95f;     // of the running mean of the targets' brightness, a frame
    uint64_t seed = 1;
    std::vector<glm::vec3> touched; // as TrainerOptions'
};

class NeuralCache : public Cache {
public:
    NeuralCache(Device& device, const NeuralCacheOptions& options, const CacheRoom& room);
    ~NeuralCache() override;

    // What the constructor will allocate, the trainer's buffers with it, for Device::plan.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                      const NeuralCacheOptions& options,
                                                      const CacheRoom& room);

    CacheBuffers buffers() const override;
    void begin(FrameGraph& graph) override;
    void beginQueries(FrameGraph& graph) override;
    void answer(FrameGraph& graph, BufferRange radiance) override;
    void learn(FrameGraph& graph, uint32_t paths, const TrainingEffort& effort = {}) override;
    CacheCounts counts() const override;
    std::map<std::string, std::string> attributes() const override;

    // What was learned: the trainer's blocks, and what its outputs mean. load() throws Error(BadData) naming
    // the file and what does not fit, and then changes nothing; what follows it predicts as what was saved.
    void save(const std::filesystem::path& file) const;
    void load(const std::filesystem::path& file);

    Trainer& trainer();

private:
    struct State;
    std::unique_ptr<State> state_;
};

CacheKind neuralCache(const NeuralCacheOptions& options);

} // namespace irradia
