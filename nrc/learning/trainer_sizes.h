// The sizes of a trainer's buffers, of which its allocation and the plan of a device's memory are made.
#pragma once

#include "engine/gpu/device.h"
#include "nrc/learning/batch_rows.h"
#include "nrc/learning/config.h"
#include "nrc/learning/network_shape.h"
#include "nrc/learning/trainer_options.h"

namespace irradia {

struct TrainerSizes {
    // What Trainer's constructor takes. Throws Error(BadData) where encoding, network and numbers do not fit
    // each other, Error(OutOfMemory) with the numbers where a binding is too small.
    TrainerSizes(bool isCpu, const VkPhysicalDeviceLimits& limits, const ModelConfig& config, uint32_t inputs,
                 uint32_t outputs, const TrainerOptions& options);

    // Every buffer of a trainer that is larger than a few quads.
    std::vector<Device::PlannedBuffer> planned() const;

    NetworkShape shape;
    uint32_t inputQuads = 0, encodedQuads = 0; // of a row
    uint64_t features = 0;
    BatchRows batch;
    uint32_t inferRows = 0; // that are predicted together

    // Bytes of rows in the network's precision, and of rows in single precision.
    uint64_t encodedBytes(uint64_t rows) const { return rows * encodedQuads * shape.quadBytes; }
    uint64_t inputBytes(uint64_t rows) const { return rows * inputQuads * 16; }
    uint64_t resultBytes(uint64_t rows) const { return rows * shape.outputQuads() * 16; }
    uint64_t encodedGradientBytes() const { return features > 0 ? encodedBytes(batch.partRows) : 16; }
};

} // namespace irradia
