#include "nrc/learning/encoding_layout.h"

#include "engine/error.h"
#include <algorithm>

namespace irradia {
namespace {

// Values of a slice of many inputs at most: its kernel is unrolled.
constexpr uint32_t kMostValues = 256;

uint32_t roundUp(uint32_t n, uint32_t multiple) {
    return (n + multiple - 1) / multiple * multiple;
}

// Of encodings that treat each input alike; 0 of others.
uint32_t valuesPerInput(const EncodingConfig& config) {
    switch (config.type) {
    case EncodingType::Identity:
        return 1;
    case EncodingType::Frequency:
        return 2 * config.frequencies;
    case EncodingType::TriangleWave:
        return config.frequencies;
    case EncodingType::OneBlob:
        return config.bins;
    default:
        return 0;
    }
}

uint32_t valuesOf(const EncodingConfig& config) {
    if (config.type == EncodingType::SphericalHarmonics) return config.degree * config.degree;
    if (isGrid(config.type)) return config.featuresPerLevel * (config.mean ? 1 : config.levels);
    return config.dims * valuesPerInput(config);
}

void checkPart(const EncodingConfig& config, size_t part) {
    if (isGrid(config.type) && config.dims != 2 && config.dims != 3)
        fail(ExitCode::BadData, "encoding part {}: a grid takes 2 or 3 inputs, not {}", part, config.dims);
    if (config.type == EncodingType::SphericalHarmonics && config.dims != 3)
        fail(ExitCode::BadData, "encoding part {}: spherical harmonics take 3 inputs, not {}", part,
             config.dims);
    if (config.type == EncodingType::SphericalHarmonics && (config.degree < 1 || config.degree > 4))
        fail(ExitCode::BadData, "encoding part {}: spherical harmonics have degree 1 to 4, not {}", part,
             config.degree);
    if (valuesOf(config) == 0) fail(ExitCode::BadData, "encoding part {}: makes no values", part);
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

bool areAlike(const EncodingConfig& a, const EncodingConfig& b) {
    return a.type == b.type && valuesPerInput(a) != 0 && valuesPerInput(a) == valuesPerInput(b) &&
           a.gaussian == b.gaussian && a.scale == b.scale && a.offset == b.offset;
}

// A slice as several, each of which fills whole quads but for the last.
void appendSplit(std::vector<EncodingSlice>& slices, EncodingSlice slice) {
    const uint32_t perInput = valuesPerInput(slice.config);
    const uint32_t most = perInput == 0 ? slice.config.dims : std::max(4u, kMostValues / perInput / 4 * 4);
    for (uint32_t left = slice.config.dims; left > 0; left -= slice.config.dims) {
        slice.config.dims = std::min(left, most);
        slice.values = valuesOf(slice.config);
        slices.push_back(slice);
        slice.firstInput += slice.config.dims;
        slice.firstQuad += slice.quads();
    }
}

} // namespace

bool isGrid(EncodingType type) {
    return type == EncodingType::DenseGrid || type == EncodingType::SparseGrid ||
           type == EncodingType::HashGrid;
}

EncodingLayout layOut(const std::vector<EncodingConfig>& parts, uint32_t inputs) {
    if (parts.empty()) fail(ExitCode::BadData, "encoding: has no part");
    EncodingLayout layout{inputs, 0, {}};
    std::vector<EncodingSlice> whole;
    uint32_t input = 0;
    const std::vector<EncodingConfig> all = resolved(parts, inputs);
    for (size_t p = 0; p < all.size(); input += all[p++].dims) {
        if (all[p].type == EncodingType::Empty) continue;
        checkPart(all[p], p);
        whole.push_back({all[p], input, valuesOf(all[p]), layout.encodedQuads});
        layout.encodedQuads += whole.back().quads();
    }
    if (whole.empty()) fail(ExitCode::BadData, "encoding: leaves all inputs out");

    std::vector<EncodingSlice> merged;
    for (const EncodingSlice& slice : whole) {
        EncodingSlice* before = merged.empty() ? nullptr : &merged.back();
        const bool isNext = before && before->firstInput + before->config.dims == slice.firstInput;
        if (isNext && areAlike(before->config, slice.config) && before->values % 4 == 0) {
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

} // namespace irradia
