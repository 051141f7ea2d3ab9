// degree^2 values of a direction: bands 0 to degree - 1.
#include "kernels/learning.h"
#include "nrc/learning/encodings/kind.h"
#include <fmt/format.h>

namespace irradia {
namespace {

std::string misfit(const EncodingConfig& config) {
    if (config.dims != 3) return fmt::format("spherical harmonics take 3 inputs, not {}", config.dims);
    const uint32_t degree = config.whole("degree");
    if (degree < 1 || degree > 4)
        return fmt::format("spherical harmonics have degree 1 to 4, not {}", degree);
    return {};
}

} // namespace

EncodingKind sphericalHarmonics() {
    return {.otype = "SphericalHarmonics",
            .keys = {wholeKey("degree", 1, 4, 4)},
            .values =
                [](const EncodingConfig& config) { return config.whole("degree") * config.whole("degree"); },
            .misfit = misfit,
            .kernel = &kernels::encode_spherical_harmonics,
            .halfKernel = &kernels::encode_spherical_harmonics_half,
            .constants = [](const EncodingConfig& config) -> std::vector<uint32_t> {
                return {config.whole("degree")};
            }};
}

} // namespace irradia
