#include "samples/pictures/pictures.h"
#include "samples/pictures/same_size.h"
#include <ImfRgbaFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <cmath>
#include <half.h>

namespace irradia {
namespace {

void join(std::string& values, const std::string& value) {
    if (values.empty())
        values = value;
    else if (values != value && !values.ends_with("," + value))
        values += "," + value;
}

half rounded(float value, const LayeredImage& picture) {
    if (!(std::abs(value) <= HALF_MAX))
        fail(ExitCode::BadData, "{}: {} is beyond half floats", picture.name, value);
    return half(value);
}

} // namespace

LayeredImage meanPicture(std::span<const LayeredImage> pictures) {
    requireSameSize(pictures);
    LayeredImage mean;
    mean.width = pictures[0].width;
    mean.height = pictures[0].height;
    mean.name = "the mean";
    std::vector<glm::dvec3> sums(pictures[0].rgb().size());
    for (const LayeredImage& picture : pictures) {
        const std::vector<glm::vec3> pixels = picture.rgb();
        for (size_t i = 0; i < sums.size(); ++i) sums[i] += pixels[i];
        for (const auto& [name, value] : picture.attributes) join(mean.attributes[name], value);
    }
    std::vector<glm::vec3> pixels;
    for (const glm::dvec3& sum : sums) pixels.emplace_back(sum / static_cast<double>(pictures.size()));
    mean.setRgb("", pixels);
    return mean;
}

void writeHalfExr(const std::filesystem::path& file, const LayeredImage& picture) {
    std::vector<Imf::Rgba> pixels;
    for (const glm::vec3& pixel : picture.rgb())
        pixels.emplace_back(rounded(pixel.r, picture), rounded(pixel.g, picture), rounded(pixel.b, picture));
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : picture.attributes) header.insert(name, Imf::StringAttribute(value));
    Imf::StdOSStream stream;
    {
        Imf::RgbaOutputFile output(stream, header, Imf::WRITE_RGB);
        output.setFrameBuffer(pixels.data(), 1, static_cast<size_t>(picture.width));
        output.writePixels(picture.height);
    }
    const std::string bytes = stream.str();
    writeFileAtomically(file, std::span(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()));
}

} // namespace irradia
