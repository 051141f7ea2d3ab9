#include "nrc/learning/encoding_layout.h"

#include "engine/error.h"
#include "nrc/learning/encodings/table.h"
#include <algorithm>

namespace irradia {
namespace {

// Values of a slice of many inputs at most: its kernel is unrolled.
constexpr uint32_t kMostValues = 256;

uint32_t roundUp(uint32_t n, uint32_t multiple) {
    return (n + multiple - 1) / multiple * multiple;
}

uint32_t valuesOf(const EncodingSlice& slice) {
    return slice.kind->values(slice.config);
}

// Of encodings that treat inputs alike.
uint32_t valuesPerInput(const EncodingSlice& slice) {
    EncodingConfig ofOne = slice.config;
    ofOne.dims = 1;
    return slice.kind->values(ofOne);
}

void checkPart(const EncodingSlice& slice, size_t part) {
    const std::string misfit = slice.kind->misfit ? slice.kind->misfit(slice.config) : "";
    if (!misfit.empty()) fail(ExitCode::BadData, "encoding part {}: {}", part, misfit);
    if (valuesOf(slice) == 0) fail(ExitCode::BadData, "encoding part {}: makes no values", part);
}

// Parts with a number of inputs each, which sum to `inputs`: one may leave it open.
std::vector<EncodingConfig> resolved(std::vector<EncodingConfig> parts, uint32_t inputs) {
    uint64_t taken = 0;
    EncodingConfig* open = nullptr;
    for (EncodingConfig& part : parts) {
        taken += part.dims;
        if (part.dims != 0) continue;
        if (open)
            fail(ExitCode::BadData, "encoding: parts {} and {} both take the inputs that are left",
                 open - parts.data(), &part - parts.data());
        open = &part;
    }
    if (taken > inputs || (taken < inputs && !open) || (open && taken == inputs))
        fail(ExitCode::BadData, "encoding: its parts take {}{} inputs, there are {}", taken,
             open ? " and at least one more" : "", inputs);
    if (open) open->dims = inputs - static_cast<uint32_t>(taken);
    return parts;
}

bool areAlike(const EncodingSlice& a, const EncodingSlice& b) {
    return a.kind == b.kind && a.kind->treatsInputsAlike && a.config.keys == b.config.keys;
}

// A slice as several, each of which fills whole quads but for the last.
void appendSplit(std::vector<EncodingSlice>& slices, EncodingSlice slice) {
    const uint32_t most = slice.kind->treatsInputsAlike
                              ? std::max(4u, kMostValues / valuesPerInput(slice) / 4 * 4)
                              : slice.config.dims;
    for (uint32_t left = slice.config.dims; left > 0; left -= slice.config.dims) {
        slice.config.dims = std::min(left, most);
        slice.values = valuesOf(slice);
        slices.push_back(slice);
        slice.firstInput += slice.config.dims;
        slice.firstQuad += slice.quads();
    }
}

} // namespace

EncodingLayout layOut(const std::vector<EncodingConfig>& parts, uint32_t inputs) {
    if (parts.empty()) fail(ExitCode::BadData, "encoding: has no part");
    EncodingLayout layout{inputs, 0, {}};
    std::vector<EncodingSlice> whole;
    uint32_t input = 0;
    const std::vector<EncodingConfig> all = resolved(parts, inputs);
    for (size_t p = 0; p < all.size(); input += all[p++].dims) {
        EncodingSlice slice{&encodingKind(all[p].otype), all[p], input, 0, layout.encodedQuads};
        if (!slice.kind->values) continue;
        checkPart(slice, p);
        slice.values = valuesOf(slice);
        layout.encodedQuads += slice.quads();
        whole.push_back(std::move(slice));
    }
    if (whole.empty()) fail(ExitCode::BadData, "encoding: leaves all inputs out");

    std::vector<EncodingSlice> merged;
    for (const EncodingSlice& slice : whole) {
        EncodingSlice* before = merged.empty() ? nullptr : &merged.back();
        const bool isNext = before && before->firstInput + before->config.dims == slice.firstInput;
        if (isNext && areAlike(*before, slice) && before->values % 4 == 0) {
            before->config.dims += slice.config.dims;
            before->values += slice.values;
        } else {
            merged.push_back(slice);
        }
    }
    for (const EncodingSlice& slice : merged) appendSplit(layout.slices, slice);

    const uint32_t used = layout.encodedQuads;
    layout.encodedQuads = roundUp(used, gpu::kFeaturePadding / 4);
    layout.slices.back().paddingQuads = layout.encodedQuads - used;
    return layout;
}

FeatureLayout layOutFeatures(const EncodingLayout& layout, const VkPhysicalDeviceLimits& limits,
                             std::span<const glm::vec3> touched) {
    FeatureLayout all;
    for (const EncodingSlice& slice : layout.slices) {
        std::unique_ptr<SliceFeatures>& features = all.slices.emplace_back();
        if (!slice.kind->features) continue;
        features = slice.kind->features(slice.config, {all.count, limits, touched});
        all.count = (features->end() + kFeatureAlignment - 1) / kFeatureAlignment * kFeatureAlignment;
        if (const auto sum = features->checksumBehind(all.checksum.value_or(0))) all.checksum = sum;
    }
    return all;
}

} // namespace irradia
