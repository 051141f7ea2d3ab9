#include "samples/fit_image/picture.h"

#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/image/read_file.h"
#include "samples/fit_image/srgb.h"
#include <algorithm>
#include <array>
#include <glm/gtc/packing.hpp>

namespace irradia {
namespace {

constexpr float kLargestHalf = 65504.0f;

uint64_t packed(const glm::vec3& colour) {
    return glm::packHalf4x16(glm::vec4(glm::clamp(colour, -kLargestHalf, kLargestHalf), 0.0f));
}

// NaN shows as black.
float displayed(float linear) {
    return linear > 0 ? encodeSrgb(std::min(linear, 1.0f)) : 0.0f;
}

void requireSize(uint64_t width, uint64_t height, const std::string& name) {
    if (width * height > kMaxPicturePixels)
        fail(ExitCode::BadData, "{}: {} x {} pixels are too many, at most {} can be learned", name, width,
             height, kMaxPicturePixels);
}

Picture fromBytes(const Rgba8Image& image, const std::string& name) {
    Picture picture{static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height), {}};
    requireSize(picture.width, picture.height, name);
    std::array<float, 256> linear;
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = decodeSrgb(static_cast<float>(i) / 255.0f);
    picture.pixels.resize(image.pixels.size() / 4);
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const uint8_t* rgba = image.pixels.data() + 4 * i;
        picture.pixels[i] = packed({linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]});
    }
    return picture;
}

Picture fromExr(const std::filesystem::path& file) {
    const LayeredImage image = readExr(file);
    Picture picture{static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height), {}};
    requireSize(picture.width, picture.height, file.string());
    const std::vector<glm::vec3> colours = image.rgb();
    picture.pixels.reserve(colours.size());
    for (const glm::vec3& colour : colours) {
        if (glm::any(glm::isnan(colour)) || glm::any(glm::isinf(colour)))
            fail(ExitCode::BadData, "{}: not finite at pixel ({}, {})", file.string(),
                 picture.pixels.size() % picture.width, picture.pixels.size() / picture.width);
        picture.pixels.push_back(packed(colour));
    }
    return picture;
}

} // namespace

glm::vec3 Picture::colour(size_t pixel) const {
    return glm::unpackHalf4x16(pixels[pixel]);
}

Picture loadPicture(const std::filesystem::path& file) {
    constexpr std::array<uint8_t, 4> kExrMagic{0x76, 0x2f, 0x31, 0x01};
    const std::vector<uint8_t> bytes = readFile(file);
    if (bytes.size() >= 4 && std::equal(kExrMagic.begin(), kExrMagic.end(), bytes.begin()))
        return fromExr(file);
    return fromBytes(decodeImage(bytes, file.string()), file.string());
}

void DisplayError::add(const glm::vec3& colour, const glm::vec3& reference) {
    for (int c = 0; c < 3; ++c) {
        const double difference = displayed(colour[c]) - displayed(reference[c]);
        sum_ += difference * difference;
    }
    count_ += 3;
}

double DisplayError::psnr() const {
    return -10 * std::log10(sum_ / static_cast<double>(count_));
}

} // namespace irradia
