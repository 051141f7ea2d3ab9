#include "nrc/learning/encoding_kernels.h"

#include "engine/error.h"
#include "kernels/learning.h"
#include <bit>

namespace irradia {
namespace {

uint32_t floatBits(double value) {
    return std::bit_cast<uint32_t>(static_cast<float>(value));
}

// Of shaders/learning/encode.glsl. The padding is written, so it is unknown to kernels that only read.
std::vector<Specialisation> sliceConstants(const EncodingLayout& layout, const EncodingSlice& slice) {
    return {{2, layout.inputQuads()}, {3, slice.firstInput}, {4, slice.config.dims},
            {5, layout.encodedQuads}, {6, slice.firstQuad},  {7, slice.paddingQuads}};
}

// Of shaders/learning/grid.glsl.
std::vector<Specialisation> gridConstants(const EncodingLayout& layout, const EncodingSlice& slice,
                                          const FeatureGrid& grid) {
    std::vector<Specialisation> constants = sliceConstants(layout, slice);
    constants.insert(constants.end(), {{8, grid.kind},
                                       {9, slice.config.levels},
                                       {10, slice.config.featuresPerLevel},
                                       {11, slice.config.mean}});
    return constants;
}

} // namespace

Kernel makeEncodeKernel(Device& device, const EncodingLayout& layout, const EncodingSlice& slice,
                        Precision precision) {
    const EncodingConfig& config = slice.config;
    KernelOptions options;
    options.constants = sliceConstants(layout, slice);
    const auto make = [&](const KernelSource& single, const KernelSource& half,
                          std::initializer_list<Specialisation> own) {
        options.constants.insert(options.constants.end(), own);
        return Kernel(device, precision == Precision::Half ? half : single, options);
    };
    switch (config.type) {
    case EncodingType::Identity:
        return make(kernels::encode_identity, kernels::encode_identity_half,
                    {{8, floatBits(config.scale)}, {9, floatBits(config.offset)}});
    case EncodingType::Frequency:
    case EncodingType::TriangleWave:
        return make(kernels::encode_frequency, kernels::encode_frequency_half,
                    {{8, config.frequencies}, {9, config.type == EncodingType::TriangleWave}});
    case EncodingType::OneBlob:
        return make(kernels::encode_one_blob, kernels::encode_one_blob_half,
                    {{8, config.bins}, {9, config.gaussian}});
    case EncodingType::SphericalHarmonics:
        return make(kernels::encode_spherical_harmonics, kernels::encode_spherical_harmonics_half,
                    {{8, config.degree}});
    default:
        fail(ExitCode::Internal, "encoding: a grid has kernels of its own");
    }
}

Kernel makeEncodeGridKernel(Device& device, const EncodingLayout& layout, const EncodingSlice& slice,
                            const FeatureGrid& grid, Precision precision) {
    KernelOptions options;
    options.constants = gridConstants(layout, slice, grid);
    return Kernel(device, precision == Precision::Half ? kernels::encode_grid_half : kernels::encode_grid,
                  options);
}

Kernel makeAccumulateKernel(Device& device, const EncodingLayout& layout, const EncodingSlice& slice,
                            const FeatureGrid& grid, uint64_t features, Precision precision) {
    KernelOptions options;
    options.constants = gridConstants(layout, slice, grid);
    options.constants.push_back({12, static_cast<uint32_t>(features)});
    const bool half = precision == Precision::Half;
    return Kernel(device, half ? kernels::accumulate_grid_gradient_half : kernels::accumulate_grid_gradient,
                  options);
}

} // namespace irradia
