// A scene and a cache that learns it, as the suites about what caches get wrong
// want it: learning apart from looking, and looking with the same rays each
// time.
#pragma once

#include "nrc/renderer/nrc_renderer.h"

namespace irradia::test {

// Of six Lambert walls with their fronts inside.
void addRoom(Scene& scene, uint32_t material, const glm::vec3& low, const glm::vec3& high);

double luminance(const glm::vec3& colour);
double meanLuminance(const FilmImage& film);

// Of a renderer whose cache is a network.
Trainer& trainerOf(NrcRenderer& renderer);

GpuScene uploaded(Device& device, const Scene& scene);

class CachedScene {
public:
    // `bounds`: where the cache is asked, the scene's unless given.
    CachedScene(Device& device, const Scene& scene, const NrcOptions& options,
                std::optional<Bounds> bounds = {});

    // The film of so many frames that train.
    FilmImage learn(const Camera& camera, uint32_t frames);
    // The film of frames 0 to `frames` - 1 as the cache is now; it stays so.
    FilmImage view(const Camera& camera, uint32_t frames = 1);

    NrcRenderer& renderer() { return renderer_; }

private:
    GpuScene gpu_;
    NrcRenderer renderer_;
    uint32_t learned_ = 0; // frames
};

} // namespace irradia::test
