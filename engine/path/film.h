// The film on the device: running means over frames of what paths brought in, and the AOV layers.
#pragma once

#include "engine/graph/frame_graph.h"
#include "engine/path/film_image.h"
#include "engine/path/wave_buffers.h"
#include "engine/scene/gpu_scene.h"

namespace irradia {

class Film {
public:
    Film(Device& device, const GpuScene& scene, const PathTracerOptions& options);

    // What the constructor allocates, in its order.
    static std::vector<Device::PlannedBuffer> planned(bool isCpu, const PathTracerOptions& options);

    // Adds the radiance of a wave's paths; with the last samples of its pixels a frame is complete there.
    void add(FrameGraph& graph, const WaveBuffers& buffers, const Wave& wave) const;
    // Adds the first hits of the wave, while its camera rays stand in the first queue; nothing without
    // layers.
    void recordLayers(FrameGraph& graph, const WaveBuffers& buffers, const Buffer& constants,
                      const Wave& wave, const gpu::WaveParams& params) const;
    void endFrame() { ++frames_; }
    void forget(FrameGraph& graph); // the next frame is the first

    uint32_t frames() const { return frames_; }
    FilmImage read() const;

private:
    // Per pixel of the picture, in parts that devices allocate at once: whole runs of a wave's pixels.
    BufferRange ofPixels(const std::vector<Buffer>& parts, uint32_t vectors, const Wave& wave) const;

    Device& device_;
    const GpuScene& scene_;
    PathTracerOptions options_;
    Kernel update_, recordLayers_;
    Buffer sampleSums_; // vec4 per pixel of a wave: of the frame's samples in waves before
    std::vector<Buffer> pixels_, layers_;
    uint32_t pixelsOfPart_;
    uint32_t frames_ = 0;
};

} // namespace irradia
