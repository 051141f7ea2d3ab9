#include "samples/session/views.h"

#include "engine/error.h"
#include "engine/image/metrics.h"
#include <algorithm>
#include <fmt/ranges.h>

namespace irradia {
namespace {

constexpr View kPicture;
constexpr View kViews[] = {
    {.name = "prediction", .isFirstHit = true},
    {.name = "without-reflectance", .isFirstHit = true, .reflectance = false},
    {.name = "raw-weights", .isFirstHit = true, .weights = Weights::Raw},
    {.name = "end-vertex", .counted = gpu::kViewEndVertex},
    {.name = "path-length", .counted = gpu::kViewPathLength},
    {.name = "training-density", .counted = gpu::kViewTrainingDensity},
    {.name = "bounce-heat", .counted = gpu::kViewPathLength, .isHeatMap = true},
    {.name = "error-sign", .isErrorSign = true},
};

} // namespace

void View::applyTo(MethodRequest& request) const {
    request.paths.view = counted;
    if (isFirstHit) request.firstHit = FirstHitView{name, weights, reflectance};
}

void View::finish(FilmImage& film, std::span<const glm::vec3> reference) const {
    if (!isHeatMap && !isErrorSign) return;
    film.variance.clear(); // was that of what is now painted over
    if (isErrorSign) film.mean = errorSigns(film.width, film.height, film.mean, reference);
    if (isHeatMap)
        for (glm::vec3& pixel : film.mean) pixel = heatColour(pixel.r);
}

Rgba8Image View::display(const FilmImage& film, const DisplayOptions& options) const {
    if (!showsNumbers()) return toDisplay(film.width, film.height, film.mean, options);
    std::vector<glm::vec3> shown = film.mean;
    if (counted != gpu::kViewPicture && !isHeatMap) {
        float largest = 0.0f;
        for (const glm::vec3& pixel : shown) largest = std::max(largest, pixel.r);
        if (largest > 0.0f)
            for (glm::vec3& pixel : shown) pixel /= largest;
    }
    return toDisplay(film.width, film.height, shown);
}

std::vector<std::string> viewNames() {
    std::vector<std::string> names;
    for (const View& view : kViews) names.emplace_back(view.name);
    return names;
}

const View& findView(std::string_view name) {
    if (name.empty()) return kPicture;
    for (const View& view : kViews)
        if (name == view.name) return view;
    fail(ExitCode::Usage, "--view {} is unknown; there are {}", name, fmt::join(viewNames(), ", "));
}

} // namespace irradia
