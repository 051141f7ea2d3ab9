// WebP through libwebp.
#include "engine/error.h"
#include "engine/image/decode.h"
#include <webp/decode.h>

namespace irradia {

Rgba8Image decodeWebp(std::span<const uint8_t> bytes, const std::string& name) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
        fail(ExitCode::BadData, "{}: not a usable WebP", name);
    if (features.has_animation) fail(ExitCode::BadData, "{}: a WebP that moves is no picture", name);
    const auto width = static_cast<uint64_t>(features.width), height = static_cast<uint64_t>(features.height);
    checkDecodedSize(width, height, name);
    Rgba8Image image{features.width, features.height, std::vector<uint8_t>(4 * width * height)};
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.pixels.data(), image.pixels.size(),
                            4 * image.width))
        fail(ExitCode::BadData, "{}: damaged WebP", name);
    return image;
}

} // namespace irradia
