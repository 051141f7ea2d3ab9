#include "nrc/renderer/nrc_methods.h"

#include "engine/error.h"
#include <fmt/ranges.h>

namespace irradia {
namespace {

constexpr uint32_t kWarmup = 64;

std::vector<MethodOption> cacheOptions() {
    return {{"preset",
             fmt::format("Of the cache: {}, or a .json file, which may inherit what it does not give: "
                         "{{\"base\": \"balanced\", ...}}",
                         fmt::join(nrcPresetNames(), ", ")),
             "balanced", "the preset", true},
            {"network", "Model of the cache, a .json file; with a \"base\", that preset's model changed", "",
             "the network", false}};
}

NrcConfig readConfig(const MethodRequest& request) {
    const std::vector<MethodOption> options = cacheOptions();
    const std::string preset = valueOf(request.options, options[0]),
                      network = valueOf(request.options, options[1]);
    NrcConfig config = preset.ends_with(".json") ? loadNrcConfig(preset) : nrcPreset(preset);
    if (!network.empty()) config.model = loadCacheModel(network);
    if (request.form != NetworkForm::Auto) config.model.network.form = request.form;
    return config;
}

void showFirstHit(const FirstHitView& view, NrcConfig& config) {
    if (!view.reflectance && !config.factorise)
        fail(ExitCode::Usage, "--view {}: this cache does not factorise its reflectance", view.name);
    config.endDepth = 0;
    config.shown = view.weights;
    config.showReflectance = view.reflectance;
}

Method withCache(const char* name, const char* help, bool endsAtFirstHit) {
    Method method;
    method.name = name;
    method.help = help;
    method.options = cacheOptions();
    method.warmup = kWarmup;
    method.hasCache = true;
    method.setup = [endsAtFirstHit](const MethodRequest& request) {
        const NrcConfig preset = readConfig(request);
        NrcOptions options{request.paths, preset, request.seed, std::nullopt};
        if (endsAtFirstHit) options.config.endDepth = 0;
        if (request.firstHit) showFirstHit(*request.firstHit, options.config);
        return std::make_unique<NrcSetup>(options, preset);
    };
    return method;
}

} // namespace

Method nrc() {
    return withCache("nrc", "with a radiance cache", false);
}

Method cacheView() {
    return withCache("cache-view", "the cache at the first hit", true);
}

std::vector<Device::PlannedBuffer> NrcSetup::planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                                     const PathTracerOptions& paths) const {
    NrcOptions options = options_;
    options.paths = paths;
    return NrcRenderer::planned(isCpu, limits, options);
}

std::unique_ptr<Renderer> NrcSetup::make(const RendererPlace& place) const {
    return std::make_unique<NrcRenderer>(place.device, place.scene, place.bounds, options_, place.profiler);
}

} // namespace irradia
