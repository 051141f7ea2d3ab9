#include "tests/support/light_harness.h"

namespace irradia::test {

namespace {

std::vector<Specialisation> fitted(const SceneNeeds& needs, std::vector<Specialisation> faults) {
    faults.push_back({gpu::kConstantEnvironment, needs.environment});
    faults.push_back({gpu::kConstantEmitters, needs.emitters});
    faults.push_back({gpu::kConstantTextures, needs.textures});
    faults.push_back({gpu::kConstantLightTree, needs.lightTree});
    faults.push_back({gpu::kConstantPunctual, needs.punctual});
    return faults;
}

struct Push {
    gpu::FrameConstants frame;
    gpu::LightHarnessParams harness;
};

} // namespace

LightHarness::LightHarness(const Scene& scene, const KernelSource& source, std::vector<Specialisation> faults)
    : scene_(uploadScene(validatedDevice(), packScene(scene), Bvh{}))
    , kernel_(source, fitted(scene_.needs, std::move(faults))) {}

std::vector<glm::uvec4> LightHarness::run(const gpu::LightHarnessParams& harness, uint32_t seed,
                                          size_t records, const std::vector<BufferRange>& more) {
    Push push{};
    push.frame.seed = seed;
    push.frame.lightCount = scene_.lightCount;
    push.frame.environmentWidth = scene_.environmentWidth;
    push.frame.environmentHeight = scene_.environmentHeight;
    push.frame.environmentShare = scene_.lightShares.environment;
    push.frame.directionalShare = scene_.lightShares.directional;
    push.frame.localShare = scene_.lightShares.local;
    push.frame.directionalCount = scene_.directionalCount;
    push.frame.firstPunctual = scene_.firstPunctual;
    push.harness = harness;
    std::vector<BufferRange> inputs{scene_.geometry,    scene_.attributes,      scene_.materials,
                                    scene_.textures,    scene_.texels,          scene_.lights,
                                    scene_.environment, scene_.environmentAlias};
    inputs.insert(inputs.end(), more.begin(), more.end());
    return kernel_.run(inputs, push, harness.count, records);
}

} // namespace irradia::test
