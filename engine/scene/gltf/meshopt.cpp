#include "engine/scene/gltf/meshopt.h"

#include "engine/scene/gltf/plain_json.h"
#include "engine/scene/gltf/values.h"
#include <meshoptimizer.h>

namespace irradia::gltf {
namespace {

class ViewDecoder {
public:
    ViewDecoder(const SourceFile& source, const tinygltf::Value& extension, Thing owner)
        : source_(source)
        , extension_(extension)
        , owner_(std::move(owner))
        , mode_(text("mode", "ATTRIBUTES"))
        , filter_(text("filter", "NONE"))
        , count_(number("count"))
        , stride_(number("byteStride")) {}

    std::vector<uint8_t> decode(DecodedData& decoded) {
        checkShape();
        const auto bytes = decoded.encoded(owner_, static_cast<int>(plainNumber(extension_, "buffer", -1)),
                                           number("byteOffset"), number("byteLength"));
        std::vector<uint8_t> data = decoded.room(owner_, count_ * stride_, bytes.size());
        if (decodeInto(data.data(), bytes) != 0)
            source_.refuse(owner_, "MESHOPT_INVALID_STREAM", "the {} bytes of compressed data are damaged",
                           bytes.size());
        applyFilter(data.data());
        return data;
    }

    uint64_t decodedBytes() const { return count_ * stride_; }

private:
    std::string text(const std::string& key, const char* otherwise) const {
        const tinygltf::Value& value = member(extension_, key);
        return value.IsString() ? value.Get<std::string>() : otherwise;
    }

    uint64_t number(const std::string& key) const { // which the guard holds to integers from 0 up
        return static_cast<uint64_t>(plainNumber(extension_, key, 0));
    }

    // As the extension and the library's functions require.
    void checkShape() const {
        const bool isAttributes = mode_ == "ATTRIBUTES", isTriangles = mode_ == "TRIANGLES";
        if (!isAttributes && !isTriangles && mode_ != "INDICES")
            source_.refuse(owner_.at("mode"), "VALUE_NOT_IN_LIST", "mode '{}'", mode_);
        const bool isStride =
            isAttributes ? stride_ % 4 == 0 && stride_ > 0 && stride_ <= 256 : stride_ == 2 || stride_ == 4;
        if (!isStride)
            source_.refuse(owner_.at("byteStride"), "VALUE_NOT_IN_LIST", "byteStride {} of {}", stride_,
                           mode_);
        if (count_ == 0 || (isTriangles && count_ % 3 != 0))
            source_.refuse(owner_.at("count"), "VALUE_NOT_IN_RANGE", "count {} of {}", count_, mode_);
        checkFilter(isAttributes);
    }

    void checkFilter(bool isAttributes) const {
        if (filter_ == "NONE") return;
        const bool isOctahedral = filter_ == "OCTAHEDRAL", isQuaternion = filter_ == "QUATERNION";
        if (!isOctahedral && !isQuaternion && filter_ != "EXPONENTIAL")
            source_.refuse(owner_.at("filter"), "VALUE_NOT_IN_LIST", "filter '{}'", filter_);
        const bool fits = isAttributes && (!isOctahedral || stride_ == 4 || stride_ == 8) &&
                          (!isQuaternion || stride_ == 8);
        if (!fits)
            source_.refuse(owner_.at("filter"), "VALUE_NOT_IN_LIST", "filter {} of {}, {} bytes apart",
                           filter_, mode_, stride_);
    }

    int decodeInto(uint8_t* data, std::span<const uint8_t> bytes) const {
        if (mode_ == "ATTRIBUTES")
            return meshopt_decodeVertexBuffer(data, count_, stride_, bytes.data(), bytes.size());
        if (mode_ == "TRIANGLES")
            return meshopt_decodeIndexBuffer(data, count_, stride_, bytes.data(), bytes.size());
        return meshopt_decodeIndexSequence(data, count_, stride_, bytes.data(), bytes.size());
    }

    void applyFilter(uint8_t* data) const {
        if (filter_ == "OCTAHEDRAL") meshopt_decodeFilterOct(data, count_, stride_);
        if (filter_ == "QUATERNION") meshopt_decodeFilterQuat(data, count_, stride_);
        if (filter_ == "EXPONENTIAL") meshopt_decodeFilterExp(data, count_, stride_);
    }

    const SourceFile& source_;
    const tinygltf::Value& extension_;
    Thing owner_;
    std::string mode_, filter_;
    uint64_t count_, stride_;
};

} // namespace

void decodeMeshopt(const SourceFile& source, tinygltf::Model& model, DecodedData& decoded) {
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        tinygltf::BufferView& view = model.bufferViews[i];
        const Extension extension = findExtension(view.extensions, kMeshopt);
        if (!extension) continue;
        const Thing owner = thing("buffer view", "bufferViews", i, view.name);
        source.attempt({}, {}, [&] {
            ViewDecoder decoder(source, *extension, owner.at("extensions").at(kMeshopt));
            if (decoder.decodedBytes() != view.byteLength)
                source.refuse(owner.at("byteLength"), "VALUE_NOT_IN_RANGE", "{} bytes, compressed are {}",
                              view.byteLength, decoder.decodedBytes());
            view.buffer = decoded.addBuffer(decoder.decode(decoded));
            view.byteOffset = 0;
        });
    }
}

} // namespace irradia::gltf
