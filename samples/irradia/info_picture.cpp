// irradia info of pictures.
#include "engine/image/exr_facts.h"
#include "engine/image/image.h"
#include "engine/image/read_file.h"
#include "info.h"
#include "samples/support/sheet.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

using nlohmann::ordered_json;

// ---- OpenEXR

std::string describe(const ExrWindow& window) {
    const std::string size = fmt::format("{} x {}", window.width(), window.height());
    if (window.left == 0 && window.top == 0) return size;
    return fmt::format("{}, from {} {} to {} {}", size, window.left, window.top, window.right, window.bottom);
}

std::string layerOf(const std::string& channel) {
    const size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

// "Albedo  B G R, half" or, where the types differ, each with its own.
std::string describeLayer(const ExrPart& part, const std::string& layer) {
    std::string text, type;
    bool isOneType = true;
    for (const ExrChannel& channel : part.channels)
        if (layerOf(channel.name) == layer) {
            isOneType = isOneType && (type.empty() || type == channel.type);
            type = channel.type;
        }
    for (const ExrChannel& channel : part.channels) {
        if (layerOf(channel.name) != layer) continue;
        text += (text.empty() ? "" : " ") + channel.name.substr(layer.empty() ? 0 : layer.size() + 1);
        if (!isOneType) text += fmt::format(" ({})", channel.type);
        if (channel.xSampling != 1 || channel.ySampling != 1)
            text += fmt::format(" (every {} x {} pixels)", channel.xSampling, channel.ySampling);
    }
    if (isOneType) text += ", " + type;
    return layer.empty() ? text : fmt::format("{}: {}", layer, text);
}

void addPart(const ExrPart& part, Sheet& sheet) {
    sheet.add("size", describe(part.displayWindow));
    if (part.dataWindow != part.displayWindow) sheet.add("data window", describe(part.dataWindow));
    sheet.add("stored as", fmt::format("{}, compression {}", part.type, part.compression));
    std::vector<std::string> lines;
    for (const std::string& layer : part.layers) lines.push_back(describeLayer(part, layer));
    sheet.add("channels", lines);
    sheet.add("not finite", part.nonFinitePixels ? fmt::format("{} pixels", *part.nonFinitePixels)
                                                 : std::string("not counted"));
    for (const ExrAttribute& attribute : part.attributes) sheet.add(attribute.name, attribute.value);
}

ordered_json toJson(const ExrWindow& window) {
    return {window.left, window.top, window.right, window.bottom};
}

ordered_json toJson(const ExrPart& part) {
    auto channels = ordered_json::array();
    for (const ExrChannel& channel : part.channels)
        channels.push_back({{"name", channel.name},
                            {"type", channel.type},
                            {"sampling", {channel.xSampling, channel.ySampling}}});
    ordered_json attributes = ordered_json::object();
    for (const ExrAttribute& attribute : part.attributes) attributes[attribute.name] = attribute.value;
    return {{"name", part.name},
            {"type", part.type},
            {"width", part.displayWindow.width()},
            {"height", part.displayWindow.height()},
            {"display_window", toJson(part.displayWindow)},
            {"data_window", toJson(part.dataWindow)},
            {"compression", part.compression},
            {"layers", part.layers},
            {"channels", channels},
            {"nonfinite_pixels", part.nonFinitePixels ? ordered_json(*part.nonFinitePixels) : ordered_json()},
            {"attributes", attributes}};
}

// ---- pictures of one size and no more

void printSize(const std::filesystem::path& file, const char* format, const std::string& words, int width,
               int height, bool asJson) {
    if (asJson)
        return printJson({{"file", file.string()},
                          {"kind", "picture"},
                          {"format", format},
                          {"width", width},
                          {"height", height}});
    Sheet sheet;
    sheet.add("file", file.string());
    sheet.add("kind", words);
    sheet.add("size", fmt::format("{} x {}", width, height));
    sheet.print();
}

} // namespace

void printExrInfo(const std::filesystem::path& file, bool asJson) {
    const std::vector<ExrPart> parts = readExrFacts(file);
    if (asJson) {
        auto list = ordered_json::array();
        for (const ExrPart& part : parts) list.push_back(toJson(part));
        return printJson({{"file", file.string()}, {"kind", "picture"}, {"format", "exr"}, {"parts", list}});
    }
    Sheet sheet;
    sheet.add("file", file.string());
    sheet.add("kind", parts.size() == 1 ? "OpenEXR picture"
                                        : fmt::format("OpenEXR picture of {} parts", parts.size()));
    for (const ExrPart& part : parts) {
        if (parts.size() > 1) sheet.add("part", fmt::format("'{}'", part.name));
        addPart(part, sheet);
    }
    sheet.print();
}

void printHdrInfo(const std::filesystem::path& file, bool asJson) {
    const LayeredImage image = readHdr(file);
    printSize(file, "hdr", "Radiance HDR picture", image.width, image.height, asJson);
}

void printScreenPictureInfo(const std::filesystem::path& file, bool asJson) {
    const std::vector<uint8_t> bytes = readFile(file);
    const Rgba8Image image = decodeImage(bytes, file.string());
    const auto print = [&](const char* format, const std::string& words) {
        printSize(file, format, words, image.width, image.height, asJson);
    };
    if (bytes.front() == 0x89) return print("png", "PNG picture");
    if (bytes.front() == 'R') return print("webp", "WebP picture");
    print("jpeg", "JPEG picture");
}

} // namespace irradia
