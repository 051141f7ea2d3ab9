// The methods' table: all that the command line, a viewer and charts know of methods. A method is added by
// one row, made in a file of its own.
#pragma once

#include "engine/gpu/profiler.h"
#include "engine/path/path_tracer_options.h"
#include "engine/scene/gpu_scene.h"
#include "nrc/learning/trainer.h"
#include "nrc/renderer/renderer.h"
#include <span>

namespace irradia {

// A view that shows a cache at the first hit in place of the picture.
struct FirstHitView {
    std::string name; // for messages
    Weights weights = Weights::Ema;
    bool reflectance = true; // false: what is predicted, before it is multiplied by the reflectance
};

// What a method's renderer is made from; each takes what concerns it.
struct MethodRequest {
    PathTracerOptions paths;
    uint64_t seed = 1;
    std::map<std::string, std::string> options; // of its own, by name; what is not given is as usual
    NetworkForm form = NetworkForm::Auto;       // of networks; Auto = as they are configured
    std::optional<FirstHitView> firstHit;       // of methods with a cache
};

// What renderers are made on, which outlives them.
struct RendererPlace {
    Device& device;
    const GpuScene& scene;
    Bounds bounds; // of the scene without strays (sceneBox)
    Profiler* profiler = nullptr;
};

// A request as its method has read and checked it, before there is a device or a scene.
class MethodSetup {
public:
    explicit MethodSetup(const PathTracerOptions& paths)
        : paths_(paths) {}
    virtual ~MethodSetup() = default;

    const PathTracerOptions& paths() const { return paths_; } // as requested
    // All buffers of a renderer of such a picture on a device of these limits, for Device::plan.
    virtual std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                       const PathTracerOptions& paths) const = 0;
    virtual bool needsAreaTable() const { return false; } // packed into the scene
    // What was read, for the files that are written: name -> text.
    virtual std::map<std::string, std::string> attributes() const { return {}; }
    virtual std::unique_ptr<Renderer> make(const RendererPlace& place) const = 0;

private:
    PathTracerOptions paths_;
};

struct MethodOption {
    std::string name; // on the command line, without its dashes
    std::string help;
    std::string usual; // where it is not given
    // What messages call the file that a value names: any value, or those that end in .json where
    // `takesNames`. Empty: values name no files.
    std::string file;
    bool takesNames = false;
};

// As given, else as usual.
const std::string& valueOf(const std::map<std::string, std::string>& given, const MethodOption& option);

struct Method {
    std::string name;
    std::string help;                  // one line
    std::vector<MethodOption> options; // of its own
    uint32_t warmup = 0;               // frames that only teach, where none are asked for; 0 = it has none
    bool hasCache = false;             // that views can show
    // Why it does not apply to a scene; empty where it does. No function: it applies to all.
    std::function<std::string(const Scene& scene)> whyNot;
    // Throws Error where an option of the method's own cannot be used.
    std::function<std::unique_ptr<MethodSetup>(const MethodRequest& request)> setup;

    const MethodOption* option(std::string_view named) const; // null: it has none of this name
};

// "pt", "nrc", "cache-view", and what was added.
std::vector<std::string> methodNames();
// Throws Error(Usage) naming those there are. What is found stays where it is.
const Method& findMethod(std::string_view name);
void addMethod(Method method); // throws Error(Internal) where the name is taken

// Where nobody chooses. What is indirect, the cache is asked for; without it there is nothing to ask.
const Method& usualMethod(uint32_t maxBounces);

// Throws Error(Usage) with the reason where the method does not apply to the scene.
void requireApplies(const Method& method, const Scene& scene);

} // namespace irradia
