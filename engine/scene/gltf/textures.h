// A material's use of a texture: which picture, at which coordinates, wrapped how.
#pragma once

#include "engine/scene/gltf/images.h"
#include "engine/scene/gltf/values.h"

namespace irradia::gltf {

// A texture info of glTF or of an extension, with its KHR_texture_transform.
struct TextureInfo {
    int texture = -1; // none
    int texCoord = 0; // the transform's, where it names one
    Extension transform = nullptr;
};

// Of tinygltf's TextureInfo, NormalTextureInfo and their like.
template <typename Info>
TextureInfo textureInfo(const Info& info) {
    const Extension transform = findExtension(info.extensions, "KHR_texture_transform");
    const double set = transform ? plainNumber(*transform, "texCoord", info.texCoord) : info.texCoord;
    return {info.index, static_cast<int>(set), transform};
}

// The same as the member `key` of an extension.
TextureInfo textureInfo(const tinygltf::Value& extension, const std::string& key);

// The image a texture shows, -1 where it has none of a format that can be read.
int imageOf(const tinygltf::Texture& texture);

// The model has passed validateModel. What has no usable picture is left out with a warning.
class TextureReader {
public:
    TextureReader(const SourceFile& source, const tinygltf::Model& model, ImageTable& images)
        : source_(source)
        , model_(model)
        , images_(images) {}

    TextureRef read(const Values& material, const TextureInfo& info) const;

private:
    bool isUsable(const Thing& texture, int image) const;

    const SourceFile& source_;
    const tinygltf::Model& model_;
    ImageTable& images_;
};

} // namespace irradia::gltf
