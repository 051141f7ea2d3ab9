// What `render` and `bench frame` share: the options that say what to render, and the opened scene, device
// and tracer.
#pragma once

#include "engine/path/wavefront_path_tracer.h"
#include "engine/scene/load_scene.h"
#include "nrc/renderer/nrc_renderer.h"
#include "samples/support/outputs.h"
#include "scripted_changes.h"
#include "views.h"
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

namespace irradia {

struct RenderRequest {
    std::string scene;
    std::string method = "pt";
    std::string size = "512x512";
    uint32_t samplesPerFrame = 1;
    uint32_t maxBounces = 16;
    uint32_t seed = 1;
    std::string sampler = "sobol";
    std::string preset = "balanced"; // of the methods with a cache: a name, or a file
    std::string view;                // empty = the picture
    std::string reference;           // EXR that the view error-sign compares with
    std::string network;             // JSON of nrc/config.h, instead of the preset's model
    std::string camera;
    std::string environment;
    std::string changes; // JSON of scripted_changes.h
    uint32_t firstFrame = 0;
    std::optional<uint32_t> endFrame; // number after the last frame's, where it is known beforehand
    bool surfaces = false;
    bool strict = false; // warnings about the scene are errors
    DeviceOptions device;
    std::string records = "auto"; // form of the kernels
    std::string heading;          // of the log, said when the scene is there
};

// The files that the request names, whether they exist or not.
std::vector<NamedFile> inputFiles(const RenderRequest& request);

// Adds the options of a request, grouped by topic.
void addRequestOptions(CLI::App& command, RenderRequest& request);

// A scene on a device, ready to render. Says on stderr what was loaded, what was left out, and where it runs.
class RenderSession {
public:
    explicit RenderSession(const RenderRequest& request);

    // Makes the changes up to this frame, renders it and closes it in the profiler; returns its wall-clock
    // milliseconds. Numbers grow from the request's first frame on.
    double renderFrame(uint32_t number);
    // The same for frame `index` = 0, 1, ... of the warm-up: it sees the scene of the first frame, and its
    // random numbers are those of no other frame.
    double renderWarmupFrame(uint32_t index);
    // What was rendered so far only trained: the film and the profiler begin anew.
    void endWarmup();

    const RenderRequest& request() const { return request_; }
    const Scene& scene() const { return scene_; }
    std::vector<NamedFile> inputs() const; // every file that was read for it
    Device& device() { return *device_; }
    const View& view() const { return view_; }
    const NrcConfig& preset() const { return preset_; } // with all it inherits, of methods with a cache
    FilmImage readFilm() const;                         // as the view shows it
    const WavefrontPathTracer& tracer() const { return nrc_ ? nrc_->tracer() : *tracer_; }
    NrcRenderer* nrc() { return nrc_.get(); } // null where the method has no cache
    Profiler& profiler() { return profiler_; }
    const Camera& camera() const { return camera_; }
    glm::uvec2 size() const { return size_; }

private:
    bool hasCache() const;
    void applyChanges(uint32_t frame);
    double renderWith(uint32_t randomIndex);
    void forgetFilm();
    NrcOptions rendererOptions() const;
    void createRenderer(const NrcOptions& options, const SceneRecords& records, const Bvh& bvh);

    RenderRequest request_;
    glm::uvec2 size_;
    NrcConfig preset_;
    View view_;
    std::vector<glm::vec3> reference_;
    Scene scene_;
    Camera camera_;
    std::string environment_; // where it came from
    ScriptedChanges changes_;
    std::unique_ptr<Device> device_;
    GpuScene gpuScene_;
    Profiler profiler_;
    std::unique_ptr<WavefrontPathTracer> tracer_; // one of the two
    std::unique_ptr<NrcRenderer> nrc_;
};

} // namespace irradia
