// The frames of `irradia render`: warm-up, then the film's, until their number, the time or a signal ends
// them.
#pragma once

#include "samples/session/render_session.h"
#include <limits>
#include <optional>

namespace irradia {

// Frames [first, end), and at least one: after `seconds` no further one begins.
struct FramePlan {
    uint32_t first = 0;
    uint32_t end = 1;
    double seconds =
        std::numeric_limits<double>::infinity(); // warm-up included, which takes half of it at most
    uint32_t warmup = 0;
};

// "N" or half-open "A-B" of --frames; throws Error(Usage).
FramePlan parseFrames(const std::string& text);

// What the film was like after a frame.
struct FrameNote {
    uint32_t frame = 0;   // how many there were
    double seconds = 0.0; // since the first frame of the warm-up began
    double mean = 0.0;    // luminance of the picture
    std::optional<float> loss;
    uint32_t records = 0; // of the frame
};

struct RenderedFrames {
    uint32_t warmup = 0;            // as far as the time went
    uint32_t first = 0, end = 0;    // of the film
    std::string endedBy;            // "frames", "time", or a signal
    double seconds = 0.0;           // warm-up included
    std::vector<FrameNote> history; // after frames 1, 2, 4, 8, ...
};

// Throws Error(Usage) where frames would repeat the samples of others.
void requireOwnSamples(const FramePlan& plan, uint32_t samplesPerFrame);

// Throws Error(Interrupted) before the first frame of the film. The history costs a read of the film each.
RenderedFrames renderFrames(RenderSession& session, const FramePlan& plan, const std::string& progress,
                            bool withHistory);

} // namespace irradia
