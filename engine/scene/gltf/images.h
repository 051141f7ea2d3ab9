// The pictures that materials use, each decoded once.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include "engine/scene/scene.h"
#include <vector>

namespace irradia::gltf {

class ImageTable {
public:
    ImageTable(const SourceFile& source, const tinygltf::Model& model, std::vector<TextureImage>& images);

    // The image is a file beside the scene, and that is not there.
    bool isMissing(int image) const;
    std::string nameOf(int image) const; // "image 3 'bark.png'", as messages say it

    // The scene's index for the file's image; it is decoded later, once.
    int use(int image);

    // Decodes every picture in use. Throws BadData naming the file and the image; NotFound for a missing
    // file.
    void decode();

private:
    TextureImage decodeOne(size_t image) const;

    const SourceFile& source_;
    const tinygltf::Model& model_;
    std::vector<TextureImage>& images_;
    std::vector<int> slots_;   // the scene's index by the file's, -1 = unused
    std::vector<size_t> used_; // the file's index by the scene's
};

} // namespace irradia::gltf
