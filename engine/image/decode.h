// What the decoders of 8-bit pictures share.
#pragma once

#include "engine/image/image.h"

namespace irradia {

constexpr uint64_t kMaxDecodedPixels = uint64_t{1} << 26;

// Throws Error(BadData) for an empty picture or one above kMaxDecodedPixels.
void checkDecodedSize(uint64_t width, uint64_t height, const std::string& name);

Rgba8Image decodePng(std::span<const uint8_t> bytes, const std::string& name);
Rgba8Image decodeJpeg(std::span<const uint8_t> bytes, const std::string& name);
Rgba8Image decodeWebp(std::span<const uint8_t> bytes, const std::string& name);

} // namespace irradia
