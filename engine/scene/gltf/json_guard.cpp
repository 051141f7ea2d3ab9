#include "engine/scene/gltf/json_guard.h"

#include "engine/scene/gltf/data_uri.h"
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

namespace irradia::gltf {
namespace {

constexpr size_t kMaxDepth = 64;            // glTF itself needs about 10; extras may nest freely
constexpr uint64_t kMaxValues = 1ull << 22; // a value of `extras` costs tinygltf about 150 bytes
constexpr uint64_t kMaxIndex = (1ull << 31) - 1;
constexpr uint64_t kMaxSize = 1ull << 53; // the integers JSON can exchange (RFC 8259, 6)

// Properties of the glTF 2.0 schema, and of the extensions read here, that are integers from 0 up.
const std::set<std::string, std::less<>> kIntegerProperties{"buffer",
                                                            "bufferView",
                                                            "byteLength",
                                                            "byteOffset",
                                                            "byteStride",
                                                            "camera",
                                                            "children",
                                                            "componentType",
                                                            "count",
                                                            "index",
                                                            "indices",
                                                            "input",
                                                            "inverseBindMatrices",
                                                            "joints",
                                                            "light",
                                                            "magFilter",
                                                            "material",
                                                            "mesh",
                                                            "minFilter",
                                                            "mode",
                                                            "node",
                                                            "nodes",
                                                            "output",
                                                            "sampler",
                                                            "scene",
                                                            "skeleton",
                                                            "skin",
                                                            "source",
                                                            "texCoord",
                                                            "wrapS",
                                                            "wrapT"};
const std::set<std::string, std::less<>> kSizeProperties{"byteLength", "byteOffset", "count"};

// Follows the parser and knows where it is; nlohmann's parser keeps its own stack on the heap, so depth is
// safe.
class Guard : public nlohmann::json_sax<nlohmann::json> {
public:
    Guard(const SourceFile& source, Schema schema, JsonFindings& findings)
        : source_(source)
        , schema_(schema)
        , findings_(findings) {}

    bool null() override { return notAnInteger("null"); }
    bool boolean(bool) override { return notAnInteger("a boolean"); }
    bool number_float(double, const std::string& text) override { return notAnInteger(text); }
    bool binary(nlohmann::json::binary_t&) override { return notAnInteger("binary data"); }

    bool number_integer(int64_t value) override { return notAnInteger(std::to_string(value)); }

    bool number_unsigned(uint64_t value) override {
        countValue();
        const std::string_view name = property();
        if (!isInteger(name)) return true;
        const uint64_t limit = kSizeProperties.contains(name) && !isSparse() ? kMaxSize : kMaxIndex;
        if (value > limit) source_.report(here(), "VALUE_NOT_IN_RANGE", "{} is above {}", value, limit);
        if (isOfBuffer("byteLength")) buffer().byteLength = value;
        return true;
    }

    bool string(std::string& value) override {
        if (path_.size() == 2 && path_[0].key == "extensionsUsed") findings_.extensionsDeclared.insert(value);
        if (path_.size() == 2 && path_[0].key == "extensionsRequired")
            findings_.extensionsRequired.insert(value);
        if (isOfBuffer("uri") && !isDataUri(value)) buffer().uri = value;
        return notAnInteger("a text");
    }

    bool start_object(size_t) override { return open(false); }
    bool start_array(size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        path_.back().key = name;
        if (path_.size() > 1 && path_[path_.size() - 2].key == "extensions" && !isExtra())
            findings_.extensionsFound.insert(name);
        return true;
    }

    bool parse_error(size_t position, const std::string&, const nlohmann::json::exception& error) override {
        // "[json.exception...] parse error at line 1, column 3: what was met; last read: 'maybe no text at
        // all'"
        const std::string text = error.what();
        const size_t begin = text.find("] ");
        source_.refuse(
            Thing{}, fmt::format("INVALID_JSON at byte {}", position), "{}",
            text.substr(begin == std::string::npos ? 0 : begin + 2, text.find("; last read") - begin - 2));
    }

private:
    struct Level {
        bool isArray = false;
        std::string key;    // of an object: the member being read
        uint64_t index = 0; // of an array: the element being read
    };

    bool open(bool isArray) {
        countValue();
        if (path_.size() == kMaxDepth) source_.refuse("{}: JSON nested deeper than {}", where(), kMaxDepth);
        path_.push_back({isArray, {}, 0});
        return true;
    }

    bool close() {
        path_.pop_back();
        return true;
    }

    void countValue() {
        if (++values_ > kMaxValues) source_.refuse("the JSON holds more than {} values", kMaxValues);
        if (!path_.empty() && path_.back().isArray) ++path_.back().index;
    }

    bool notAnInteger(std::string_view found) {
        countValue();
        if (isInteger(property()))
            source_.report(here(), "TYPE_MISMATCH", "a non-negative integer is needed, not {}", found);
        return true;
    }

    // The member being read; an array's elements go by the array's name.
    std::string_view property() const {
        for (size_t i = path_.size(); i-- > 0;)
            if (!path_[i].isArray) return path_[i].key;
        return {};
    }

    // buffers/B/NAME
    bool isOfBuffer(std::string_view name) const {
        return schema_ == Schema::Gltf && path_.size() == 3 && path_[0].key == "buffers" &&
               path_[2].key == name;
    }

    BufferClaim& buffer() {
        findings_.buffers.resize(std::max<size_t>(findings_.buffers.size(), path_[1].index));
        return findings_.buffers[path_[1].index - 1];
    }

    bool isExtra() const {
        return std::ranges::any_of(path_, [](const Level& level) { return level.key == "extras"; });
    }

    bool isInteger(std::string_view name) const {
        if (schema_ == Schema::Any) return false;
        for (const Level& level : path_) {
            if (level.key == "extras") return false;
            if (level.key == "extensions")
                return name == "index" || name == "texCoord" || name == "light"; // a texture's, a node's
        }
        return kIntegerProperties.contains(name) || isAttribute();
    }

    // meshes/M/primitives/P/attributes/NAME or meshes/M/primitives/P/targets/T/NAME
    bool isAttribute() const {
        return path_.size() >= 6 && path_[0].key == "meshes" && path_[2].key == "primitives" &&
               ((path_.size() == 6 && path_[4].key == "attributes") ||
                (path_.size() == 7 && path_[4].key == "targets"));
    }

    // accessors/A/sparse/...: tinygltf keeps these sizes in 32 bits.
    bool isSparse() const {
        return path_.size() >= 3 && path_[0].key == "accessors" && path_[2].key == "sparse";
    }

    // A JSON pointer to the value being read, "/accessors/3/count".
    std::string where() const {
        std::string text;
        for (const Level& level : path_)
            text +=
                level.isArray ? fmt::format("/{}", level.index == 0 ? 0 : level.index - 1) : "/" + level.key;
        return text.size() <= 120 ? text : text.substr(0, 120) + "...";
    }
    Thing here() const { return {where(), where()}; }

    const SourceFile& source_;
    Schema schema_;
    JsonFindings& findings_;
    std::vector<Level> path_;
    uint64_t values_ = 0;
};

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

JsonFindings guardJson(const SourceFile& source, std::string_view json, Schema schema) {
    JsonFindings findings;
    Guard guard(source, schema, findings);
    nlohmann::json::sax_parse(json.begin(), json.end(), &guard);
    return findings;
}

} // namespace irradia::gltf
