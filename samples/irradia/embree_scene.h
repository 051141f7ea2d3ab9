// Embree over the same triangles: the yardstick of `bench rays`, and where its rays' surfaces come from.
#pragma once

#include "engine/scene/scene.h"
#include <cstddef>
#include <functional>
#include <memory>

namespace irradia {

struct BenchRay {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f}; // unit
    float tMax = 1e30f;
};

struct EmbreeHit {
    float t = 0;
    uint32_t primitive = 0xffffffffu; // all ones = missed
    glm::vec3 normal{0.0f};           // geometric, not unit
};

class EmbreeScene {
public:
    EmbreeScene(const Scene& scene, uint32_t threads);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    EmbreeHit closest(const BenchRay& ray) const;
    bool isOccluded(const BenchRay& ray) const;

    // Calls work(begin, end) over [0, count) in runs of 256 on `threads` threads; returns the seconds it
    // took.
    double parallel(size_t count, const std::function<void(size_t begin, size_t end)>& work) const;
    uint32_t threads() const { return threads_; }

private:
    struct State;
    std::unique_ptr<State> state_;
    uint32_t threads_;
};

} // namespace irradia
