// What `irradia render` writes: the picture as EXR or PNG, and the numbers of the run.
#pragma once

#include "render_frames.h"
#include "samples/support/outputs.h"

namespace irradia {

struct RenderOutputs {
    std::string output; // .exr, or .png for the picture as a screen shows it alone
    std::string png;
    std::string stats;
    std::string exposure; // stops or "auto"; empty = 0
    std::string toneMap;  // empty = clip

    void addOptions(CLI::App& command);
    // Before any work. Throws Error(Usage or Io).
    void check(const RenderRequest& request) const;
    std::vector<NamedFile> files() const;
    std::vector<std::string> pngs() const;
};

// Writes every file that it can; throws the first error at the end.
void writeOutputs(const RenderOutputs& outputs, RenderSession& session, const FramePlan& plan,
                  const RenderedFrames& run);

} // namespace irradia
