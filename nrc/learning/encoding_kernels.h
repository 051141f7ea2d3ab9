// The kernels of an encoding's slices.
#pragma once

#include "engine/gpu/kernel.h"
#include "nrc/learning/encoding_layout.h"
#include "nrc/learning/feature_grid.h"

namespace irradia {

// encode_identity, encode_frequency, encode_one_blob or encode_spherical_harmonics.
Kernel makeEncodeKernel(Device& device, const EncodingLayout& layout, const EncodingSlice& slice,
                        Precision precision);

Kernel makeEncodeGridKernel(Device& device, const EncodingLayout& layout, const EncodingSlice& slice,
                            const FeatureGrid& grid, Precision precision);

// `features`: of all grids.
Kernel makeAccumulateKernel(Device& device, const EncodingLayout& layout, const EncodingSlice& slice,
                            const FeatureGrid& grid, uint64_t features, Precision precision);

} // namespace irradia
