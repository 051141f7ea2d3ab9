// Compressed geometry, before anything else looks at it: afterwards accessors are plain ones.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include <span>

namespace irradia::gltf {

// What decompression adds to a model, within a limit: a small file can ask for far more than it holds.
class DecodedData {
public:
    DecodedData(const SourceFile& source, tinygltf::Model& model)
        : source_(source)
        , model_(model) {}

    // The bytes of a buffer. Throws BadData for what is not there.
    std::span<const uint8_t> encoded(const Thing& at, int buffer, uint64_t offset, uint64_t length) const;

    // Room for `bytes`, made of as many as `encoded`. Throws BadData where no data can hold so much.
    std::vector<uint8_t> room(const Thing& at, uint64_t bytes, uint64_t encoded);
    // The same without room: for memory of a decoder's own.
    void count(const Thing& at, uint64_t bytes, uint64_t encoded);

    int addBuffer(std::vector<uint8_t> bytes);
    int addView(std::vector<uint8_t> bytes); // tightly packed

private:
    const SourceFile& source_;
    tinygltf::Model& model_;
    uint64_t bytes_ = 0;
};

// EXT_meshopt_compression and KHR_draco_mesh_compression. Indices in the model are unchecked. Throws BadData,
// or collects an error for each buffer view and primitive.
void decompress(const SourceFile& source, tinygltf::Model& model);

} // namespace irradia::gltf
