#include "engine/path/film_image.h"

namespace irradia {

LayeredImage toLayers(const FilmImage& film) {
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
