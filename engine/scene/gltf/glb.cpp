#include "engine/scene/gltf/glb.h"

#include <cstring>
#include <span>

namespace irradia::gltf {
namespace {

uint32_t littleEndian32(const uint8_t* bytes) {
    return bytes[0] | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
}

constexpr uint64_t kGlbHeader = 12;
constexpr uint64_t kChunkHeader = 8;
constexpr uint32_t kJsonChunk = 0x4E4F534A; // "JSON"

} // namespace

bool isBinary(const SourceFile& source) {
    return source.bytes.size() >= 4 && std::memcmp(source.bytes.data(), "glTF", 4) == 0;
}

std::string_view jsonText(const SourceFile& source) {
    const uint8_t* bytes = source.bytes.data();
    const char* text = reinterpret_cast<const char*>(bytes);
    const uint64_t size = source.bytes.size();
    if (!isBinary(source)) return {text, size};

    if (size < kGlbHeader + kChunkHeader)
        source.refuse(Thing{}, "GLB_UNEXPECTED_END_OF_HEADER", "{} bytes", size);
    const uint32_t version = littleEndian32(bytes + 4);
    if (version != 2) source.refuse(Thing{}, "GLB_INVALID_VERSION", "{}, only 2 can be read", version);
    const uint64_t length = littleEndian32(bytes + 8);
    if (length > size)
        source.refuse(Thing{}, "GLB_LENGTH_MISMATCH", "the header says {} bytes, the file has {}", length,
                      size);

    const uint64_t jsonLength = littleEndian32(bytes + kGlbHeader);
    if (littleEndian32(bytes + kGlbHeader + 4) != kJsonChunk)
        source.refuse(Thing{}, "GLB_UNEXPECTED_FIRST_CHUNK", "the first chunk is not JSON");
    if (kGlbHeader + kChunkHeader + jsonLength > length)
        source.refuse(Thing{}, "GLB_CHUNK_TOO_BIG", "{} bytes of JSON in {} bytes", jsonLength, length);
    if (jsonLength % 4 != 0)
        source.refuse(Thing{}, "GLB_CHUNK_LENGTH_UNALIGNED", "{} bytes of JSON", jsonLength);
    return {text + kGlbHeader + kChunkHeader, jsonLength};
}

std::vector<uint8_t> withJson(const SourceFile& source, std::string json) {
    if (!isBinary(source)) return {json.begin(), json.end()};
    while (json.size() % 4 != 0) json.push_back(' ');
    const std::string_view old = jsonText(source);
    const uint64_t length = littleEndian32(source.bytes.data() + 8);
    const auto rest = std::span(source.bytes).first(length).subspan(kGlbHeader + kChunkHeader + old.size());

    std::vector<uint8_t> bytes(source.bytes.begin(), source.bytes.begin() + kGlbHeader + kChunkHeader);
    bytes.insert(bytes.end(), json.begin(), json.end());
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    if (bytes.size() > kMaxFileBytes)
        source.refuse("the file is larger than the {} bytes allowed", kMaxFileBytes);
    const auto write32 = [&](uint64_t at, uint64_t value) {
        for (int byte = 0; byte < 4; ++byte) bytes[at + byte] = static_cast<uint8_t>(value >> (8 * byte));
    };
    write32(8, bytes.size());
    write32(kGlbHeader, json.size());
    return bytes;
}

} // namespace irradia::gltf
