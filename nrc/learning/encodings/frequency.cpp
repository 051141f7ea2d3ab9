// Sines and cosines of n_frequencies octaves (Mildenhall 2020), or in their stead a triangle wave of each
// (Müller 2021).
#include "kernels/learning.h"
#include "nrc/learning/encodings/kind.h"

namespace irradia {
namespace {

// `isTriangle`: one value an octave instead of two.
template <bool isTriangle>
EncodingKind waves(const char* otype) {
    return {.otype = otype,
            .keys = {wholeKey("n_frequencies", 1, 16, 12)},
            .values =
                [](const EncodingConfig& config) {
                    return config.dims * config.whole("n_frequencies") * (isTriangle ? 1 : 2);
                },
            .treatsInputsAlike = true,
            .kernel = &kernels::encode_frequency,
            .halfKernel = &kernels::encode_frequency_half,
            .constants = [](const EncodingConfig& config) -> std::vector<uint32_t> {
                return {config.whole("n_frequencies"), isTriangle};
            }};
}

} // namespace

EncodingKind frequency() {
    return waves<false>("Frequency");
}
EncodingKind triangleWave() {
    return waves<true>("TriangleWave");
}

} // namespace irradia
