// The methods that render with a neural radiance cache.
#pragma once

#include "nrc/renderer/methods.h"
#include "nrc/renderer/nrc_renderer.h"

namespace irradia {

Method nrc();       // the picture
Method cacheView(); // "cache-view": every path ends at its first hit

class NrcSetup : public MethodSetup {
public:
    explicit NrcSetup(const NrcOptions& options)
        : NrcSetup(options, options.config) {}
    // `preset`: the configuration as it was read, before a view changed it.
    NrcSetup(const NrcOptions& options, const NrcConfig& preset)
        : MethodSetup(options.paths)
        , options_(options)
        , preset_(preset) {}

    std::vector<Device::PlannedBuffer> planned(bool isCpu, const VkPhysicalDeviceLimits& limits,
                                               const PathTracerOptions& paths) const override;
    bool needsAreaTable() const override { return options_.config.uniformShare > 0.0f; }
    std::map<std::string, std::string> attributes() const override { return {{"preset", toJson(preset_)}}; }
    std::unique_ptr<Renderer> make(const RendererPlace& place) const override;

private:
    NrcOptions options_;
    NrcConfig preset_;
};

} // namespace irradia
