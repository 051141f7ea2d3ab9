#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/scene/load_scene.h"
#include <algorithm>
#include <cctype>
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

std::string lowerExtension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

LayeredImage readPicture(const std::filesystem::path& file) {
    const std::string extension = lowerExtension(file);
    if (extension == ".hdr") return readHdr(file);
    if (extension == ".exr") return readExr(file);
    fail(ExitCode::BadData, "environment '{}': neither R,G,B nor an .hdr or .exr file", file.string());
}

bool isRadiance(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) &&
           glm::all(glm::greaterThanEqual(v, {}));
}

} // namespace

Environment loadEnvironment(const std::string& text) {
    Environment environment;
    if (const auto constant = parseConstant(text)) {
        if (!isRadiance(*constant))
            fail(ExitCode::BadData, "environment '{}': radiance must be finite and not negative", text);
        environment.constant = *constant;
        return environment;
    }
    const LayeredImage picture = readPicture(text);
    environment.width = picture.width;
    environment.height = picture.height;
    environment.texels = picture.rgb();
    for (size_t i = 0; i < environment.texels.size(); ++i) {
        // Resampled pictures ring: a little below zero is no light.
        glm::vec3& texel = environment.texels[i];
        texel = glm::max(texel, glm::vec3(0.0f));
        if (!isRadiance(texel))
            fail(ExitCode::BadData, "{}: texel ({}, {}) is not finite", text, i % environment.width,
                 i / environment.width);
    }
    return environment;
}

} // namespace irradia
