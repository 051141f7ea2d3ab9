#include "tests/support/cached_scene.h"

#include "nrc/cache/neural_cache.h"
#include "tests/reference/simple_scenes.h"

namespace irradia::test {

void addRoom(Scene& scene, uint32_t material, const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 extent = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 a(0.0f), b(0.0f); // cross(a, b) along the axis
        a[(axis + 1) % 3] = extent[(axis + 1) % 3];
        b[(axis + 2) % 3] = extent[(axis + 2) % 3];
        reference::addQuad(scene, material, low, a, b);
        reference::addQuad(scene, material, high, -b, -a);
    }
}

double luminance(const glm::vec3& colour) {
    return glm::dot(glm::dvec3(colour), glm::dvec3(0.2126, 0.7152, 0.0722));
}

double meanLuminance(const FilmImage& film) {
    double sum = 0.0;
    for (const glm::vec3& pixel : film.mean) sum += luminance(pixel);
    return sum / double(film.mean.size());
}

Trainer& trainerOf(NrcRenderer& renderer) {
    return dynamic_cast<NeuralCache&>(renderer.cache()).trainer();
}

GpuScene uploaded(Device& device, const Scene& scene) {
    return uploadScene(device, packScene(scene), buildBvh(scene));
}

CachedScene::CachedScene(Device& device, const Scene& scene, const NrcOptions& options,
                         std::optional<Bounds> bounds)
    : gpu_(uploaded(device, scene))
    , renderer_(device, gpu_, bounds.value_or(sceneBounds(scene)), options) {}

FilmImage CachedScene::learn(const Camera& camera, uint32_t frames) {
    renderer_.forgetFilm();
    for (uint32_t i = 0; i < frames; ++i) renderer_.renderFrame(camera, learned_++);
    return renderer_.tracer().readFilm();
}

FilmImage CachedScene::view(const Camera& camera, uint32_t frames) {
    renderer_.forgetFilm();
    renderer_.setLearning(false);
    for (uint32_t i = 0; i < frames; ++i) renderer_.renderFrame(camera, i);
    renderer_.setLearning(true);
    return renderer_.tracer().readFilm();
}

} // namespace irradia::test
