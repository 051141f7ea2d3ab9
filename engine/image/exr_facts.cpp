#include "engine/image/exr_facts.h"

#include "engine/error.h"
#include "engine/image/exr_attribute.h"
#include "engine/image/read_file.h"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <algorithm>
#include <cmath>
#include <new>

namespace irradia {
namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
constexpr uint64_t kMaxBandValues = uint64_t{1} << 24; // 64 MiB are read at a time

// What the facts say in words of their own, or what only describes how the file is laid out.
constexpr std::string_view kToldApart[] = {"channels",      "compression", "dataWindow",
                                           "displayWindow", "name",        "type",
                                           "chunkCount",    "version",     "maxSamplesPerPixel"};

const char* nameOf(Imf::PixelType type) {
    switch (type) {
    case Imf::UINT:
        return "uint";
    case Imf::HALF:
        return "half";
    default:
        return "float";
    }
}

std::string typeOf(const Imf::Header& header) {
    if (header.hasType()) return header.type();
    return header.hasTileDescription() ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE;
}

ExrWindow toWindow(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, box.max.x, box.max.y};
}

std::string layerOf(const std::string& channel) {
    const size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

void readChannels(const Imf::Header& header, ExrPart& part) {
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        const Imf::Channel& channel = it.channel();
        part.channels.push_back({it.name(), nameOf(channel.type), channel.xSampling, channel.ySampling});
        const std::string layer = layerOf(it.name());
        if (std::ranges::find(part.layers, layer) == part.layers.end()) part.layers.push_back(layer);
    }
}

void readAttributes(const Imf::Header& header, ExrPart& part) {
    for (auto it = header.begin(); it != header.end(); ++it)
        if (std::ranges::find(kToldApart, std::string_view(it.name())) == std::end(kToldApart))
            part.attributes.push_back({it.name(), it.attribute().typeName(), textOf(it.attribute())});
    std::ranges::stable_partition(part.attributes, [](const ExrAttribute& attribute) {
        return attribute.name.starts_with("irradia.");
    });
}

// In bands of rows, so that no picture has to be held whole.
uint64_t countNonFinite(Imf::InputPart& input, const ExrPart& part) {
    std::vector<const ExrChannel*> channels;
    for (const ExrChannel& channel : part.channels)
        if (channel.type != "uint" && channel.xSampling == 1 && channel.ySampling == 1)
            channels.push_back(&channel);
    if (channels.empty()) return 0;
    const auto width = static_cast<uint64_t>(part.dataWindow.width());
    const uint64_t rowValues = width * channels.size();
    const auto rows = static_cast<int64_t>(
        std::clamp<uint64_t>(kMaxBandValues / rowValues, 1, static_cast<uint64_t>(part.dataWindow.height())));
    std::vector<std::vector<float>> values(channels.size(),
                                           std::vector<float>(width * static_cast<uint64_t>(rows)));
    uint64_t count = 0;
    for (int64_t top = part.dataWindow.top; top <= part.dataWindow.bottom; top += rows) {
        const int first = static_cast<int>(top);
        const int last = static_cast<int>(std::min<int64_t>(top + rows - 1, part.dataWindow.bottom));
        const Imath::Box2i band({part.dataWindow.left, first}, {part.dataWindow.right, last});
        Imf::FrameBuffer frame;
        for (size_t c = 0; c < channels.size(); ++c)
            frame.insert(channels[c]->name, Imf::Slice::Make(Imf::FLOAT, values[c].data(), band));
        input.setFrameBuffer(frame);
        input.readPixels(first, last);
        const uint64_t pixels = width * static_cast<uint64_t>(last - first + 1);
        for (uint64_t i = 0; i < pixels; ++i)
            count += std::ranges::any_of(values, [i](const auto& v) { return !std::isfinite(v[i]); }) ? 1 : 0;
    }
    return count;
}

ExrPart readPart(Imf::MultiPartInputFile& file, int index) {
    const Imf::Header& header = file.header(index);
    ExrPart part;
    part.name = header.hasName() ? header.name() : "";
    part.type = typeOf(header);
    part.compression = nameOfCompression(header.compression());
    part.dataWindow = toWindow(header.dataWindow());
    part.displayWindow = toWindow(header.displayWindow());
    readChannels(header, part);
    readAttributes(header, part);
    const int64_t width = part.dataWindow.width(), height = part.dataWindow.height();
    const bool isSmall =
        width > 0 && height > 0 && static_cast<uint64_t>(width) <= kMaxPixels / static_cast<uint64_t>(height);
    if (isSmall && !Imf::isDeepData(part.type)) {
        Imf::InputPart input(file, index);
        part.nonFinitePixels = countNonFinite(input, part);
    }
    return part;
}

} // namespace

std::vector<ExrPart> readExrFacts(const std::filesystem::path& file) {
    requireFile(file);
    try {
        Imf::MultiPartInputFile input(file.c_str(), 0);
        std::vector<ExrPart> parts;
        for (int index = 0; index < input.parts(); ++index) parts.push_back(readPart(input, index));
        return parts;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail(ExitCode::BadData, "{}: not a usable OpenEXR picture: {}", file.string(), error.what());
    }
}

} // namespace irradia
