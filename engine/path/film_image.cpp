#include "engine/path/film_image.h"

#include "engine/error.h"

namespace irradia {

void FilmImage::reserve(size_t pixels, bool hasVariance, bool hasLayers) {
    mean.reserve(pixels);
    if (hasVariance) variance.reserve(pixels);
    if (!hasLayers) return;
    for (std::vector<glm::vec3>* layer : {&albedo, &normal, &position}) layer->reserve(pixels);
    depth.reserve(pixels);
}

uint64_t FilmImage::hostBytes(uint64_t pixels, bool hasLayers) {
    const uint64_t film = 2 * sizeof(glm::vec3) + (hasLayers ? 3 * sizeof(glm::vec3) + sizeof(float) : 0);
    return pixels * (2 * film + sizeof(float)); // as vectors and as channels, and the count of samples
}

void requireFrames(const FilmImage& film) {
    if (film.frames == 0) fail(ExitCode::Internal, "no frame was rendered, so that there is no picture");
}

LayeredImage toLayers(const FilmImage& film) {
    requireFrames(film);
    LayeredImage image;
    image.width = film.width;
    image.height = film.height;
    image.setRgb("", film.mean);
    if (!film.variance.empty()) image.setRgb("Variance", film.variance);
    image.channels["SampleCount.V"].assign(film.mean.size(),
                                           static_cast<float>(double(film.frames) * film.samplesPerFrame));
    if (!film.albedo.empty()) {
        image.setRgb("Albedo", film.albedo);
        image.setRgb("N", film.normal, "XYZ");
        image.setRgb("P", film.position, "XYZ");
        image.channels["Z"] = film.depth;
    }
    return image;
}

} // namespace irradia
