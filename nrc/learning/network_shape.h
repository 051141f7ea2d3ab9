// Sizes of a network, in values and quads (shared/network.h).
#pragma once

#include "nrc/learning/batch_rows.h"
#include "nrc/learning/config.h"
#include "shared/network.h"

namespace irradia {

struct NetworkShape {
    uint32_t inputs = 0; // a multiple of gpu::kFeaturePadding
    uint32_t width = 0;
    uint32_t hiddenLayers = 0;
    uint32_t outputs = 0;
    uint32_t quadBytes = 16; // of a quad in the network's precision

    uint32_t inputQuads() const { return inputs / 4; }
    uint32_t widthQuads() const { return width / 4; }
    uint32_t outputQuads() const { return (outputs + 3) / 4; }
    uint32_t largestQuads() const { return inputQuads() > widthQuads() ? inputQuads() : widthQuads(); }
    uint64_t hiddenWeights() const {
        return uint64_t(inputs) * width + uint64_t(hiddenLayers - 1) * width * width;
    }
    uint64_t weights() const { return hiddenWeights() + uint64_t(width) * gpu::kFeaturePadding; }
    uint64_t packedQuads() const {
        return (weights() + hiddenWeights()) / 4 + uint64_t(width) * outputQuads();
    }
    uint64_t packedBytes() const { return packedQuads() * quadBytes; }
    uint32_t activationQuads() const { return hiddenLayers * widthQuads(); }
    uint32_t gradientQuads() const { return activationQuads() + outputQuads(); }
    // Of so many rows of a batch, or of all of it.
    uint64_t activationBytes(uint64_t rows) const { return rows * activationQuads() * quadBytes; }
    uint64_t layerGradientBytes(uint64_t rows) const { return rows * gradientQuads() * quadBytes; }
    uint64_t partialBytes(uint32_t batchRows) const {
        return chunkCount(batchRows, chunkRows(batchRows)) * weights() * sizeof(float);
    }
};

// Throws Error(BadData) with the numbers that do not fit.
NetworkShape checkedShape(const NetworkConfig& config, uint32_t inputs, uint32_t outputs);

} // namespace irradia
