// A scene, a device and a method, opened together: frames are rendered, the scene and the camera changed, and
// the film read. What `render`, `bench frame` and a viewer share; it has no command line. What goes wrong is
// thrown as Error; what was loaded, what was left out and where it runs is said in the log (engine/log.h).
#pragma once

#include "engine/scene/load_scene.h"
#include "nrc/renderer/methods.h"
#include "samples/session/scripted_changes.h"
#include "samples/session/views.h"
#include "samples/support/named_file.h"
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace irradia {

struct RenderRequest {
    std::string scene;
    std::string method = "pt";                        // of the methods' table
    std::map<std::string, std::string> methodOptions; // of the method's own, those that are given
    glm::uvec2 size{512, 512};
    uint32_t samplesPerFrame = 1;
    uint32_t maxBounces = 16;
    uint32_t seed = 1;
    std::string sampler = "sobol"; // of the paths' numbers: sobol or random
    std::string view;              // empty = the picture
    std::string reference;         // EXR that the view error-sign compares with
    std::string camera;
    std::string environment;
    std::string changes; // JSON of scripted_changes.h
    uint32_t firstFrame = 0;
    std::optional<uint32_t> endFrame; // number after the last frame's, where it is known beforehand
    bool layers = false;              // gather the AOV layers
    bool strict = false;              // warnings about the scene are errors
    DeviceOptions device;             // but for the access to quads, which `form` says
    std::string form = "auto";        // of the kernels: kernel_form.h
    std::string heading;              // of the log, said when the scene is there
    // Called between the steps of opening, which take seconds; may throw.
    std::function<void()> betweenSteps;
};

// The files that the request names, whether they exist or not.
std::vector<NamedFile> inputFiles(const RenderRequest& request);

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

    // Between frames. Materials and environment may become what the request's changes make of them, and what
    // needs no more room (engine/scene/gpu_scene.h); what was learned stays.
    void change(const SceneChange& change);
    void setCamera(const Camera& camera); // the film begins anew
    void forgetFilm();
    // Another method in place of the present one, whose film and learning end.
    void setMethod(const std::string& method, const std::map<std::string, std::string>& options = {});

    FilmImage readFilm() const;    // as the view shows it
    FilmImage readRawFilm() const; // as it was rendered
    RendererStatistics statistics() const { return renderer_->statistics(); }
    // What decides the picture beside the request, by name.
    std::map<std::string, std::string> attributes() const;

    const RenderRequest& request() const { return request_; }
    const Method& method() const { return *method_; }
    const Scene& scene() const { return scene_; }
    std::vector<NamedFile> inputs() const; // every file that was read for it
    Device& device() { return *device_; }
    const View& view() const { return view_; }
    Profiler& profiler() { return profiler_; }
    const Camera& camera() const { return camera_; }
    glm::uvec2 size() const { return request_.size; }

private:
    MethodRequest methodRequest() const;
    void openScene();
    void createRenderer();
    void step() const;
    void applyChanges(uint32_t frame);
    bool apply(const SceneChange& change); // whether the scene on the device is another now
    double renderWith(uint32_t randomIndex);

    RenderRequest request_;
    const Method* method_ = nullptr;
    View view_;
    std::unique_ptr<MethodSetup> setup_;
    std::vector<glm::vec3> reference_;
    Scene scene_;
    Camera camera_;
    std::string environment_; // where it came from
    ScriptedChanges changes_;
    std::unique_ptr<Device> device_;
    GpuScene gpuScene_;
    Profiler profiler_;
    std::unique_ptr<Renderer> renderer_;
};

} // namespace irradia
