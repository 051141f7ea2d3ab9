// The mass of a kernel about each input in n_bins bins of [0, 1] (Müller 2019): Gaussian, which is exact, or
// the quartic one (2021).
#include "kernels/learning.h"
#include "nrc/learning/encodings/kind.h"

namespace irradia {

EncodingKind oneBlob() {
    return {.otype = "OneBlob",
            .keys = {wholeKey("n_bins", 1, 64, 4), choiceKey("kernel", {"Quartic", "Gaussian"})},
            .values = [](const EncodingConfig& config) { return config.dims * config.whole("n_bins"); },
            .treatsInputsAlike = true,
            .kernel = &kernels::encode_one_blob,
            .halfKernel = &kernels::encode_one_blob_half,
            .constants = [](const EncodingConfig& config) -> std::vector<uint32_t> {
                return {config.whole("n_bins"), config.whole("kernel")};
            }};
}

} // namespace irradia
