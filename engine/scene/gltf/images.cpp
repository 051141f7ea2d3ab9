#include "engine/scene/gltf/images.h"

#include "engine/image/image.h"
#include "engine/scene/gltf/data_uri.h"
#include <exception>
#include <tbb/parallel_for.h>

namespace irradia::gltf {
namespace {

constexpr uint64_t kMaxTexels = 1ull << 29; // of all pictures, 2 GiB

std::string imageName(const tinygltf::Image& image) {
    return image.name.empty() ? withoutData(image.uri) : image.name;
}

} // namespace

ImageTable::ImageTable(const SourceFile& source, const tinygltf::Model& model,
                       std::vector<TextureImage>& images)
    : source_(source)
    , model_(model)
    , images_(images)
    , slots_(model.images.size(), -1) {}

bool ImageTable::isMissing(int index) const {
    const tinygltf::Image& image = model_.images[index];
    const bool isBeside = image.bufferView < 0 && image.image.empty() && !isDataUri(image.uri);
    return isBeside && !std::filesystem::exists(resolveUri(source_, decodeUri(image.uri)));
}

std::string ImageTable::nameOf(int index) const {
    return label("image", static_cast<size_t>(index), imageName(model_.images[index]));
}

int ImageTable::use(int image) {
    if (slots_[image] < 0) {
        slots_[image] = static_cast<int>(used_.size());
        used_.push_back(static_cast<size_t>(image));
    }
    return slots_[image];
}

void ImageTable::decode() {
    images_.resize(used_.size());
    std::vector<std::exception_ptr> errors(used_.size()); // told in the file's order
    std::atomic<uint64_t> texels = 0;
    tbb::parallel_for(size_t{0}, used_.size(), [&](size_t i) {
        try {
            images_[i] = decodeOne(used_[i]);
        } catch (const Error&) {
            errors[i] = std::current_exception();
        }
        texels += images_[i].rgba.size() / 4;
        if (texels > kMaxTexels)
            source_.refuse("the pictures hold more than the {} texels allowed", kMaxTexels);
    });
    for (size_t i = 0; i < used_.size(); ++i)
        source_.attempt(thing("image", "images", used_[i]), "IMAGE_DATA_INVALID", [&] {
            if (errors[i]) std::rethrow_exception(errors[i]);
        });
}

TextureImage ImageTable::decodeOne(size_t index) const {
    const tinygltf::Image& image = model_.images[index];
    std::vector<uint8_t> external;
    std::span<const uint8_t> encoded(image.image); // of a data URI
    if (image.bufferView >= 0) {
        const tinygltf::BufferView& view = model_.bufferViews[image.bufferView];
        encoded = std::span(model_.buffers[view.buffer].data).subspan(view.byteOffset, view.byteLength);
    } else if (encoded.empty()) {
        external = readUri(source_, decodeUri(image.uri));
        encoded = external;
    }
    Rgba8Image decoded =
        decodeImage(encoded, fmt::format("{}: {}", source_.path.string(), nameOf(static_cast<int>(index))));
    return {imageName(image), decoded.width, decoded.height, std::move(decoded.pixels)};
}

} // namespace irradia::gltf
