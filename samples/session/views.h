// What --view shows in place of the picture.
#pragma once

#include "engine/image/display.h"
#include "engine/path/film_image.h"
#include "nrc/renderer/methods.h"

namespace irradia {

struct View {
    const char* name = "";
    uint32_t counted = gpu::kViewPicture; // of each path
    bool isFirstHit = false;              // the cache there
    Weights weights = Weights::Ema;       // which it shows,
    bool reflectance = true;              // and what of it
    bool isHeatMap = false;
    bool isErrorSign = false; // against a reference

    bool showsNumbers() const { return counted != gpu::kViewPicture || isHeatMap || isErrorSign; }
    bool needsCache() const { return isFirstHit || counted != gpu::kViewPicture; }
    void applyTo(MethodRequest& request) const;
    // Makes the view of what was rendered; `reference` where the view needs one.
    void finish(FilmImage& film, std::span<const glm::vec3> reference) const;
    // For a screen: white is the largest of counts. The options are for radiance, numbers take no others.
    Rgba8Image display(const FilmImage& film, const DisplayOptions& options = {}) const;
};

std::vector<std::string> viewNames();
// The picture itself has the name "". Throws Error(Usage) naming those there are.
const View& findView(std::string_view name);

} // namespace irradia
