#include "engine/graph/slices.h"

namespace irradia {

std::vector<size_t> sliceStarts(std::span<const SliceCandidate> passes, double target) {
    std::vector<size_t> starts{0};
    double slice = 0; // time of the passes from the last start to the last cut that was not taken
    double sinceCut = 0;
    size_t lastCut = 0;
    for (size_t i = 0; i < passes.size(); ++i) {
        if (passes[i].cutBefore) {
            slice += sinceCut;
            sinceCut = 0;
            lastCut = i;
        }
        sinceCut += passes[i].milliseconds;
        const bool full = slice + sinceCut > target;
        if (full && lastCut > starts.back()) {
            starts.push_back(lastCut);
            slice = 0;
        }
    }
    return starts;
}

} // namespace irradia
