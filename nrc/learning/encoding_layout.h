// Where the parts of an encoding take their inputs and put their values, and where their features lie.
#pragma once

#include "nrc/learning/config.h"
#include "shared/network.h"
#include <memory>
#include <optional>
#include <span>
#include <vulkan/vulkan.h>

namespace irradia {

struct EncodingKind;
class SliceFeatures;

// What one kernel does: a part, several equal parts side by side, or some inputs of a large part.
struct EncodingSlice {
    const EncodingKind* kind;
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

// Throws Error(BadData) naming the part and the numbers that do not fit.
EncodingLayout layOut(const std::vector<EncodingConfig>& parts, uint32_t inputs);

// The features of all slices, one slice's after the other's.
struct FeatureLayout {
    std::vector<std::unique_ptr<SliceFeatures>> slices; // of each slice, null where it has none
    uint64_t count = 0;
    std::optional<uint32_t> checksum; // of which there are, where the touched points decide it
};

// Throws Error(BadData) where a slice cannot have such features, Error(OutOfMemory) with the numbers where
// they outgrow a binding.
FeatureLayout layOutFeatures(const EncodingLayout& layout, const VkPhysicalDeviceLimits& limits,
                             std::span<const glm::vec3> touched);

} // namespace irradia
