// Where a frame is cut into submissions, from how long its passes took when they last ran. Pure.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace irradia {

struct SliceCandidate {
    double milliseconds = 0; // estimate of the pass
    bool cutBefore = false;  // a submission may end before it
};

// The first pass of each submission: as many passes as took at most `target` milliseconds together, cut only
// where allowed. The first entry is 0.
std::vector<size_t> sliceStarts(std::span<const SliceCandidate> passes, double target);

} // namespace irradia
