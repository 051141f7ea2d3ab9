#include "engine/scene/gltf/decompress.h"

#include "engine/scene/gltf/draco.h"
#include "engine/scene/gltf/meshopt.h"

namespace irradia::gltf {
namespace {

constexpr uint64_t kMaxDecodedBytes = uint64_t{1} << 30; // in all
// What either codec makes of a byte at most, in what anybody stores: runs of what repeats excepted.
constexpr uint64_t kMaxRatio = 4096;
constexpr std::string_view kTooLarge = "COMPRESSED_DATA_TOO_LARGE"; // a name of ours
constexpr uint64_t kAlwaysAllowed = uint64_t{1} << 16;

} // namespace

std::span<const uint8_t> DecodedData::encoded(const Thing& at, int buffer, uint64_t offset,
                                              uint64_t length) const {
    if (buffer < 0 || static_cast<size_t>(buffer) >= model_.buffers.size())
        source_.refuse(at.at("buffer"), "UNRESOLVED_REFERENCE", "buffer {} of {}", buffer,
                       model_.buffers.size());
    const std::vector<uint8_t>& data = model_.buffers[buffer].data;
    if (offset > data.size() || length > data.size() - offset)
        source_.refuse(at.at("byteLength"), "BUFFER_VIEW_TOO_LONG", "bytes {} + {} of the {} of buffer {}",
                       offset, length, data.size(), buffer);
    return std::span(data).subspan(offset, length);
}

void DecodedData::count(const Thing& at, uint64_t bytes, uint64_t encoded) {
    if (bytes > kAlwaysAllowed && bytes / kMaxRatio > encoded)
        source_.refuse(at, kTooLarge, "{} compressed bytes cannot hold {}", encoded, bytes);
    if (bytes > kMaxDecodedBytes - bytes_)
        source_.refuse(at, kTooLarge, "with it the compressed geometry has more than the {} bytes allowed",
                       kMaxDecodedBytes);
    bytes_ += bytes;
}

std::vector<uint8_t> DecodedData::room(const Thing& at, uint64_t bytes, uint64_t encoded) {
    count(at, bytes, encoded);
    return std::vector<uint8_t>(bytes);
}

int DecodedData::addBuffer(std::vector<uint8_t> bytes) {
    model_.buffers.emplace_back().data = std::move(bytes);
    return static_cast<int>(model_.buffers.size()) - 1;
}

int DecodedData::addView(std::vector<uint8_t> bytes) {
    tinygltf::BufferView& view = model_.bufferViews.emplace_back();
    view.byteLength = bytes.size();
    view.buffer = addBuffer(std::move(bytes));
    return static_cast<int>(model_.bufferViews.size()) - 1;
}

void decompress(const SourceFile& source, tinygltf::Model& model) {
    DecodedData decoded(source, model);
    decodeMeshopt(source, model, decoded);
    decodeDraco(source, model, decoded);
}

} // namespace irradia::gltf
