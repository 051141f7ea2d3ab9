#include "engine/image/decode.h"

#include "engine/error.h"
#include <algorithm>
#include <array>

namespace irradia {
namespace {

constexpr std::array<uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<uint8_t, 3> kJpegSignature{0xff, 0xd8, 0xff};

template <size_t N>
bool startsWith(std::span<const uint8_t> bytes, const std::array<uint8_t, N>& signature) {
    return bytes.size() >= N && std::equal(signature.begin(), signature.end(), bytes.begin());
}

// A RIFF file: the length of what follows stands between its two names.
bool isWebp(std::span<const uint8_t> bytes) {
    constexpr std::array<uint8_t, 4> kRiff{'R', 'I', 'F', 'F'}, kWebp{'W', 'E', 'B', 'P'};
    return bytes.size() >= 12 && startsWith(bytes, kRiff) && startsWith(bytes.subspan(8), kWebp);
}

} // namespace

void checkDecodedSize(uint64_t width, uint64_t height, const std::string& name) {
    if (width == 0 || height == 0) fail(ExitCode::BadData, "{}: the picture is empty", name);
    if (width > kMaxDecodedPixels || height > kMaxDecodedPixels || width * height > kMaxDecodedPixels)
        fail(ExitCode::BadData, "{}: {} x {} pixels are more than the {} allowed", name, width, height,
             kMaxDecodedPixels);
}

Rgba8Image decodeImage(std::span<const uint8_t> bytes, const std::string& name) {
    if (startsWith(bytes, kPngSignature)) return decodePng(bytes, name);
    if (startsWith(bytes, kJpegSignature)) return decodeJpeg(bytes, name);
    if (isWebp(bytes)) return decodeWebp(bytes, name);
    fail(ExitCode::BadData, "{}: neither a PNG, a JPEG nor a WebP picture", name);
}

} // namespace irradia
