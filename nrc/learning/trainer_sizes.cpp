#include "nrc/learning/trainer_sizes.h"

#include "engine/error.h"
#include "nrc/learning/encoding_layout.h"
#include "nrc/learning/encodings/slice.h"
#include <algorithm>

namespace irradia {
namespace {

// A CPU learns from a batch in parts of so many rows: each pass takes many times what starting it does, and
// what passes hand on is not much more than its caches hold.
constexpr uint32_t kCpuPartRows = 1u << 14;

uint64_t largestRow(const NetworkShape& shape, uint32_t inputQuads, uint32_t encodedQuads) {
    const uint64_t quads = std::max({shape.activationQuads(), shape.gradientQuads(), encodedQuads});
    return std::max<uint64_t>(quads * shape.quadBytes, 16ull * std::max(inputQuads, shape.outputQuads()));
}

// Rows whose quads one binding holds, each buffer's as texels too.
uint32_t boundRows(const VkPhysicalDeviceLimits& limits, uint64_t rowBytes, uint32_t quadBytes) {
    const uint64_t texels = uint64_t{limits.maxTexelBufferElements} * quadBytes;
    const uint64_t bytes = std::min<uint64_t>(limits.maxStorageBufferRange, texels);
    const uint64_t rows =
        std::min<uint64_t>(bytes / rowBytes, UINT32_MAX) / gpu::kRowPadding * gpu::kRowPadding;
    if (rows == 0)
        fail(ExitCode::OutOfMemory, "network: {} rows of {} bytes outgrow a binding of {} bytes",
             gpu::kRowPadding, rowBytes, bytes);
    return static_cast<uint32_t>(rows);
}

BatchRows cutBatch(bool isCpu, uint32_t wanted, uint32_t bound, uint64_t rowBytes) {
    const BatchRows batch(wanted, isCpu ? std::min(kCpuPartRows, bound) : bound);
    if (batch.partRows > bound)
        fail(ExitCode::OutOfMemory,
             "network: a chunk of {} rows of a batch of {}, {} bytes each, outgrows a binding: fewer or "
             "narrower layers, or smaller batches fit",
             batch.partRows, batch.rows, rowBytes);
    return batch;
}

} // namespace

TrainerSizes::TrainerSizes(bool isCpu, const VkPhysicalDeviceLimits& limits, const ModelConfig& config,
                           uint32_t inputs, uint32_t outputs, const TrainerOptions& options)
    : batch(options.batchRows, options.batchRows) {
    const EncodingLayout layout = layOut(config.encoding, inputs);
    inputQuads = layout.inputQuads();
    encodedQuads = layout.encodedQuads;
    features = layOutFeatures(layout, limits, options.touched).count;
    shape = checkedShape(config.network, encodedQuads * 4, outputs);
    const uint64_t rowBytes = largestRow(shape, inputQuads, encodedQuads);
    const uint32_t bound = boundRows(limits, rowBytes, shape.quadBytes);
    batch = cutBatch(isCpu, options.batchRows, bound, rowBytes);
    inferRows = std::min(paddedRows(options.inferRows), bound);
}

std::vector<Device::PlannedBuffer> TrainerSizes::planned() const {
    const uint64_t rows = batch.rows, part = batch.partRows;
    std::vector<Device::PlannedBuffer> list{
        {"batch inputs", inputBytes(part)},
        {"batch targets", resultBytes(part)},
        {"usable records", part * 4},
        {"encoded inputs", encodedBytes(part)},
        {"activations", shape.activationBytes(part)},
        {"results", resultBytes(part)},
        {"result gradient", resultBytes(part)},
        {"row losses", rows * 16},
        {"layer gradients", shape.layerGradientBytes(part)},
        {"gradient by encoded inputs", encodedGradientBytes()},
        {"partial weight gradients", shape.partialBytes(batch.rows)},
        {"packed weights", shape.packedBytes()},
        {"packed weights of predictions", shape.packedBytes()},
        {"encoded queries", encodedBytes(inferRows)},
    };
    // Values, moments and averages, and gradients: floats of weights, 64-bit sums of features.
    for (const char* name : {"weights", "weights' gradients", "weights' first moments",
                             "weights' second moments", "weights' averages"})
        list.push_back({name, shape.weights() * 4});
    if (features > 0)
        for (const auto& [name, bytes] : {std::pair{"features", 4u},
                                          {"features' gradients", 8u},
                                          {"features' first moments", 4u},
                                          {"features' second moments", 4u},
                                          {"features' averages", 4u}})
            list.push_back({name, features * bytes});
    return list;
}

} // namespace irradia
