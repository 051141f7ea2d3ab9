// scale * x + offset.
#include "kernels/learning.h"
#include "nrc/learning/encodings/kind.h"

namespace irradia {

EncodingKind identity() {
    return {
        .otype = "Identity",
        .keys = {optionalNumberKey("scale", {-1e6, 1e6}, 1.0), optionalNumberKey("offset", {-1e6, 1e6}, 0.0)},
        .values = [](const EncodingConfig& config) { return config.dims; },
        .treatsInputsAlike = true,
        .kernel = &kernels::encode_identity,
        .halfKernel = &kernels::encode_identity_half,
        .constants = [](const EncodingConfig& config) -> std::vector<uint32_t> {
            return {floatBits(config.number("scale")), floatBits(config.number("offset"))};
        }};
}

} // namespace irradia
