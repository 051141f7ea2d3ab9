#include "nrc/renderer/path_tracing.h"

#include "engine/path/wavefront_path_tracer.h"

namespace irradia {
namespace {

class PathTracingRenderer : public Renderer {
public:
    explicit PathTracingRenderer(const RendererPlace& place, const PathTracerOptions& options)
        : tracer_(place.device, place.scene, options, place.profiler) {}

    void renderFrame(const Camera& camera, uint32_t index) override { tracer_.renderFrame(camera, index); }
    void forgetFilm() override { tracer_.forgetFilm(); }
    FilmImage readFilm() const override { return tracer_.readFilm(); }
    RendererStatistics statistics() const override { return {.rays = tracer_.raysTraced()}; }

private:
    WavefrontPathTracer tracer_;
};

class PathTracingSetup : public MethodSetup {
public:
    using MethodSetup::MethodSetup;

    std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& /*limits*/,
                                               const PathTracerOptions& paths) const override {
        return WavefrontPathTracer::planned(isCpu, paths);
    }
    std::unique_ptr<Renderer> make(const RendererPlace& place) const override {
        return std::make_unique<PathTracingRenderer>(place, paths());
    }
};

} // namespace

Method pathTracing() {
    Method method;
    method.name = "pt";
    method.help = "path tracing";
    method.setup = [](const MethodRequest& request) {
        return std::make_unique<PathTracingSetup>(request.paths);
    };
    return method;
}

} // namespace irradia
