// Learns a picture: place in the unit square -> colour. The picture and all batches stay on the device.
#pragma once

#include "nrc/learning/trainer.h"
#include "samples/fit_image/picture.h"

namespace irradia {

struct LearnerOptions {
    uint32_t log2Batch = 14; // records of a step, 8 to 18
    uint32_t seed = 1;
};

class ImageLearner {
public:
    ImageLearner(Device& device, const Picture& picture, const ModelConfig& config,
                 const LearnerOptions& options);

    // Runs every kernel once, which compiles it, and learns nothing.
    void warmUp();
    // Draws a batch and learns it.
    void step();

    // PSNR over the whole picture, or over 65,536 fixed pixels of a larger one.
    double measure();
    // The whole picture as it is known now.
    std::vector<glm::vec3> predict();

    Trainer& trainer() { return trainer_; }
    const Profiler& profiler() const { return profiler_; } // a frame is a step

private:
    void draw(FrameGraph& graph, uint32_t log2Rows, uint32_t step, const Buffer& inputs,
              const Buffer& targets);
    void list(uint32_t first, uint32_t rows);
    // Colours of the first `rows` places in inputs_ of predictions.
    std::span<const glm::vec4> infer(const Buffer& inputs, uint32_t rows);
    void learn(uint32_t rows);

    Device& device_;
    const Picture& picture_;
    LearnerOptions options_;
    uint32_t pixels_;
    uint32_t inferRows_; // of a prediction at most
    Trainer trainer_;
    Profiler profiler_;
    FrameGraph graph_;     // of what is measured and predicted
    FrameGraph stepGraph_; // of learning, which is profiled
    Kernel drawPixels_;
    Kernel listPixels_;
    Buffer pictureRecords_;
    Buffer counters_; // rows of a batch, rows of a prediction
    Buffer batchInputs_;
    Buffer batchTargets_;
    Buffer listedInputs_;
    Buffer measuredInputs_;
    Buffer results_;
    Buffer hostResults_;
    std::vector<glm::vec3> measuredColours_;
    uint32_t step_ = 0;
};

} // namespace irradia
