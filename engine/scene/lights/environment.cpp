#include "engine/error.h"
#include "engine/image/picture_file.h"
#include "engine/scene/load_scene.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace irradia {
namespace {

// "R,G,B" with nothing else, or nothing.
std::optional<glm::vec3> parseConstant(const std::string& text) {
    glm::vec3 colour(0.0f);
    const char* at = text.data();
    const char* end = at + text.size();
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && (at == end || *at++ != ',')) return std::nullopt;
        while (at != end && *at == ' ') ++at;
        const auto [after, error] = std::from_chars(at, end, colour[c]);
        if (error != std::errc() || after == at) return std::nullopt;
        at = after;
    }
    return at == end ? std::optional(colour) : std::nullopt;
}

bool isRadiance(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) &&
           glm::all(glm::greaterThanEqual(v, {}));
}

// Half floats end at 65504, and suns are brighter: infinity stands for the largest value of half floats, or
// of the picture where that is more. What is no number is black. Resampled pictures ring: a little below zero
// is no light.
std::vector<std::string> mendTexels(std::vector<glm::vec3>& texels, const std::string& name) {
    constexpr float kLargestHalf = 65504.0f;
    float largest = kLargestHalf;
    for (const glm::vec3& texel : texels)
        for (int c = 0; c < 3; ++c)
            if (std::isfinite(texel[c])) largest = std::max(largest, texel[c]);
    uint64_t infinite = 0, unknown = 0;
    for (glm::vec3& texel : texels) {
        const glm::vec3 found = texel;
        bool isInfinite = false, isUnknown = false;
        for (int c = 0; c < 3; ++c) {
            isUnknown = isUnknown || std::isnan(found[c]);
            isInfinite = isInfinite || (std::isinf(found[c]) && found[c] > 0);
            texel[c] = std::clamp(found[c], 0.0f, largest);
        }
        if (isUnknown) texel = glm::vec3(0.0f);
        infinite += isInfinite;
        unknown += isUnknown;
    }
    std::vector<std::string> warnings;
    const auto warn = [&](uint64_t count, const std::string& what) {
        if (count > 0)
            warnings.push_back(fmt::format("{}: {} of {} texels {}", name, count, texels.size(), what));
    };
    warn(infinite, fmt::format("are infinite and become {}", largest));
    warn(unknown, "are no numbers and become black");
    return warnings;
}

} // namespace

Environment loadEnvironment(const std::string& text, SceneNotes* notes) {
    Environment environment;
    if (const auto constant = parseConstant(text)) {
        if (!isRadiance(*constant))
            fail(ExitCode::BadData, "environment '{}': radiance must be finite and not negative", text);
        environment.constant = *constant;
        return environment;
    }
    const PictureName name = parsePictureName(text);
    if (name.extension() != ".exr" && name.extension() != ".hdr")
        fail(ExitCode::BadData, "environment '{}': neither R,G,B nor an .hdr or .exr file", text);
    const LayeredImage picture = readPicture(name);
    environment.width = picture.width;
    environment.height = picture.height;
    environment.texels = picture.rgb(name.layer);
    const std::vector<std::string> warnings = mendTexels(environment.texels, text);
    if (notes) notes->warnings.insert(notes->warnings.end(), warnings.begin(), warnings.end());
    return environment;
}

} // namespace irradia
