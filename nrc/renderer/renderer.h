// What renders frames of a scene into a film, by whatever method (nrc/renderer/methods.h).
#pragma once

#include "engine/path/film_image.h"
#include "engine/scene/scene.h"
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace irradia {

// Of executed frames; a method leaves out what it has not.
struct RendererStatistics {
    uint64_t rays = 0;               // of all kinds, by the last frame
    uint32_t records = 0;            // from which the last frame has learned
    std::optional<float> loss;       // of the last step of learning
    uint32_t framesWithoutCache = 0; // of the film, path traced since the cache knew nothing
};

class Renderer {
public:
    virtual ~Renderer() = default;

    // What a method does once before the first frame, as training. `goesOn` is told what share of it is done,
    // and answers false to end it early.
    virtual void prepare(const std::function<bool(double share)>& goesOn) { static_cast<void>(goesOn); }

    // Adds a frame to the film. `index` numbers it for the random numbers.
    virtual void renderFrame(const Camera& camera, uint32_t index) = 0;
    virtual void forgetFilm() = 0; // what follows is averaged anew; what was learned stays
    virtual FilmImage readFilm() const = 0;

    // true: the frames that follow are not looked at, and only teach.
    virtual void setWarmingUp(bool warmsUp) { static_cast<void>(warmsUp); }

    virtual RendererStatistics statistics() const = 0;
    // What decides the picture beside the common options, for the files that are written: name -> text.
    virtual std::map<std::string, std::string> attributes() const { return {}; }
};

} // namespace irradia
