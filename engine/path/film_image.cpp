#include "engine/path/film_image.h"

#include "engine/error.h"

namespace irradia {

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
                                           static_cast<float>(film.frames * film.samplesPerFrame));
    if (!film.albedo.empty()) {
        image.setRgb("Albedo", film.albedo);
        image.setRgb("N", film.normal, "XYZ");
        image.setRgb("P", film.position, "XYZ");
        image.channels["Z"] = film.depth;
    }
    return image;
}

} // namespace irradia
