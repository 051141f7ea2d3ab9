// Scenes for the harness kernels of light sampling.
#pragma once

#include "engine/scene/gpu_scene.h"
#include "shared/path.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"

namespace irradia::test {

// A scene on the device without its hierarchy, and a kernel that includes tests/shaders/light_scene.glsl.
class LightHarness {
public:
    LightHarness(const Scene& scene, const KernelSource& source, std::vector<Specialisation> faults = {});

    uint32_t triangles() const { return scene_.triangles; }

    // Bindings 0 to 7, then `more`, then the output.
    std::vector<glm::uvec4> run(const gpu::LightHarnessParams& harness, uint32_t seed, size_t records,
                                const std::vector<BufferRange>& more = {});

private:
    GpuScene scene_;
    KernelHarness kernel_;
};

// Constants that plant faults (light_scene.glsl).
inline constexpr uint32_t kLightRadianceFault = 40;
inline constexpr uint32_t kLightPdfFault = 41;

} // namespace irradia::test
