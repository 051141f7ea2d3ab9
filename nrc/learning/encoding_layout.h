// Where the parts of an encoding take their inputs and put their values.
#pragma once

#include "nrc/learning/config.h"
#include "shared/network.h"

namespace irradia {

// What one kernel does: a part, several equal parts side by side, or some inputs of a large part.
struct EncodingSlice {
    EncodingConfig config; // dims is resolved
    uint32_t firstInput = 0;
    uint32_t values = 0; // of a row
    uint32_t firstQuad = 0;
    uint32_t paddingQuads = 0; // of ones behind the values

    uint32_t quads() const { return (values + 3) / 4; }
};

struct EncodingLayout {
    uint32_t inputs = 0;
    uint32_t encodedQuads = 0; // of a row
    std::vector<EncodingSlice> slices;

    uint32_t inputQuads() const { return (inputs + 3) / 4; }
};

bool isGrid(EncodingType type);

// Throws Error(BadData) naming the part and the numbers that do not fit.
EncodingLayout layOut(const std::vector<EncodingConfig>& parts, uint32_t inputs);

} // namespace irradia
