#include "engine/image/image.h"

#include "engine/error.h"

namespace irradia {
namespace {

std::string channelName(const std::string& layer, char component) {
    return layer.empty() ? std::string(1, component) : layer + "." + component;
}

std::string channelNames(const std::map<std::string, std::vector<float>>& channels) {
    constexpr size_t kShown = 200;
    std::string names;
    for (const auto& entry : channels) {
        if (names.size() > kShown) return names + ", ...";
        names += (names.empty() ? "" : ", ") + entry.first;
    }
    return names;
}

} // namespace

void LayeredImage::setRgb(const std::string& layer, std::span<const glm::vec3> pixels, const char* names) {
    for (int c = 0; c < 3; ++c) {
        auto& channel = channels[channelName(layer, names[c])];
        channel.resize(pixels.size());
        for (size_t i = 0; i < pixels.size(); ++i) channel[i] = pixels[i][c];
    }
}

std::vector<glm::vec3> LayeredImage::rgb(const std::string& layer, const char* names) const {
    std::vector<glm::vec3> pixels(size_t(width) * size_t(height));
    const bool isColour = std::string_view(names) == "RGB";
    const bool isGrey =
        isColour && !channels.contains(channelName(layer, 'R')) && channels.contains(channelName(layer, 'Y'));
    for (int c = 0; c < 3; ++c) {
        const std::string wanted = channelName(layer, isGrey ? 'Y' : names[c]);
        const auto channel = channels.find(wanted);
        if (channel == channels.end())
            fail(ExitCode::BadData, "{}: has no channel {}, only {}", name, wanted, channelNames(channels));
        if (channel->second.size() != pixels.size())
            fail(ExitCode::BadData, "{}: channel {} holds {} values, not {} x {}", name, wanted,
                 channel->second.size(), width, height);
        for (size_t i = 0; i < pixels.size(); ++i) pixels[i][c] = channel->second[i];
    }
    if (isColour && !isGrey && toRec709 != glm::mat3(1.0f))
        for (glm::vec3& pixel : pixels) pixel = toRec709 * pixel;
    return pixels;
}

} // namespace irradia
