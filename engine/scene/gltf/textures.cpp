#include "engine/scene/gltf/textures.h"

#include <cmath>

namespace irradia::gltf {
namespace {

// Beyond these a float no longer resolves a texel of the picture.
constexpr double kMaxOffset = 1e6;
constexpr double kMaxTransformScale = 1e4;

Wrap wrap(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::ClampToEdge;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::MirroredRepeat : Wrap::Repeat;
}

// Scaled, then turned about (0, 0), counter-clockwise as the picture is seen: v points down. Then moved.
glm::mat3x2 uvTransform(const Values& material, const tinygltf::Value& extension) {
    const auto pair = [&](const std::string& key, double otherwise, double limit) {
        const std::vector<double> values = numbers(extension, key);
        const auto one = [&](size_t i) {
            return material.number("KHR_texture_transform." + key, values[i], -limit, limit);
        };
        return values.size() < 2 ? glm::dvec2(otherwise) : glm::dvec2(one(0), one(1));
    };
    const glm::dvec2 offset = pair("offset", 0, kMaxOffset), scale = pair("scale", 1, kMaxTransformScale);
    const double angle = plainNumber(extension, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
    return {glm::vec2(scale.x * c, -scale.x * s), glm::vec2(scale.y * s, scale.y * c), glm::vec2(offset)};
}

} // namespace

TextureInfo textureInfo(const tinygltf::Value& extension, const std::string& key) {
    const tinygltf::Value& info = member(extension, key);
    if (!info.Has("index")) return {};
    const tinygltf::Value& transform = member(member(info, "extensions"), "KHR_texture_transform");
    const double set = plainNumber(transform, "texCoord", plainNumber(info, "texCoord", 0));
    return {info.Get("index").GetNumberAsInt(), static_cast<int>(set),
            transform.IsObject() ? &transform : nullptr};
}

int imageOf(const tinygltf::Texture& texture) {
    const Extension webp = findExtension(texture.extensions, "EXT_texture_webp"); // beside it stands the same
    return webp ? static_cast<int>(plainNumber(*webp, "source", texture.source)) : texture.source;
}

TextureRef TextureReader::read(const Values& material, const TextureInfo& info) const {
    if (info.texture < 0) return {};
    const tinygltf::Texture& from = model_.textures[info.texture];
    const Thing owner = thing("texture", "textures", static_cast<size_t>(info.texture), from.name);
    if (info.texCoord > 1) {
        source_.note(Severity::Warning, material.owner().pointer, kNotRendered,
                     fmt::format("{}: texture {} uses coordinate set {}, only 0 and 1 can be used",
                                 material.owner().name, info.texture, info.texCoord));
        return {};
    }
    const int image = imageOf(from);
    if (!isUsable(owner, image)) return {};
    TextureRef ref{images_.use(image), info.texCoord};
    if (from.sampler >= 0) {
        ref.wrapS = wrap(model_.samplers[from.sampler].wrapS);
        ref.wrapT = wrap(model_.samplers[from.sampler].wrapT);
    }
    if (info.transform) ref.transform = uvTransform(material, *info.transform);
    return ref;
}

bool TextureReader::isUsable(const Thing& texture, int image) const {
    if (image < 0) {
        source_.note(Severity::Warning, texture.pointer, kNotRendered,
                     texture.name + " has no picture of a supported format");
        return false;
    }
    bool isMissing = false;
    const Thing uri = thing("image", "images", static_cast<size_t>(image)).at("uri");
    if (!source_.attempt(uri, "INVALID_URI", [&] { isMissing = images_.isMissing(image); })) return false;
    if (isMissing)
        source_.note(Severity::Warning, uri.pointer, "IO_ERROR",
                     fmt::format("{} is left out: {} is missing", texture.name, images_.nameOf(image)));
    return !isMissing;
}

} // namespace irradia::gltf
