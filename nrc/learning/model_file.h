// What was learned, on disk: a kind and named blocks of bytes.
//
//     "IRRADNET", version, the kind, the number of blocks, then of each its name and its bytes, and the
//     CRC-32 of all that precedes it; kind, names and blocks with their lengths before them (64 bits);
//     integers and floats little-endian.
//
// A trainer has blocks of its own (nrc/learning/trainer.h). Whoever owns one adds what else its predictions
// depend on, under a kind of its own:
//
//     ModelFile model("cache");
//     model.add<gpu::CacheState>("cache state", state);
//     trainer.save(file, std::move(model));
//
//     const ModelFile model = ModelFile::read(file, "cache");
//     const auto state = model.values<gpu::CacheState>("cache state", 1);
//     trainer.load(model);
//
// Blocks that nobody asks for are left alone. Files of version 1, which had a fixed layout, are refused.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace irradia {

class ModelFile {
public:
    // Of what kind it is, in one word: no other can be read as it.
    explicit ModelFile(std::string kind)
        : kind_(std::move(kind)) {}

    // Throws Error: NotFound, Io, or BadData naming the file and what differs: no model, another version or
    // kind, cut off or changed.
    static ModelFile read(const std::filesystem::path& file, const std::string& kind);
    static ModelFile read(const std::filesystem::path& file); // of whatever kind
    // Written whole or not at all. Throws Error(Io).
    void write(const std::filesystem::path& file) const;

    // A block; its name must be new.
    template <typename T>
    void add(const std::string& name, std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        addBytes(name, std::as_bytes(values));
    }
    void addText(const std::string& name, std::string_view text) {
        addBytes(name, std::as_bytes(std::span(text)));
    }

    const std::string& kind() const { return kind_; }
    static uint32_t version(); // that is read and written

    struct BlockSize {
        std::string name;
        uint64_t bytes;
    };
    std::vector<BlockSize> blocks() const; // in the file's order

    bool has(std::string_view name) const;
    // Throw Error(BadData) naming file and block where there is none, or none of so many values.
    template <typename T>
    std::vector<T> values(const std::string& name, uint64_t count) const {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::span<const std::byte> bytes = block(name, count, sizeof(T));
        std::vector<T> values(count);
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    std::string text(const std::string& name) const;

    // Throws Error(BadData): the file, and what does not fit.
    [[noreturn]] void refuse(const std::string& what) const;

private:
    struct Block {
        std::string name;
        std::vector<std::byte> bytes;
    };

    void addBytes(const std::string& name, std::span<const std::byte> bytes);
    const Block& find(std::string_view name) const;
    std::span<const std::byte> block(const std::string& name, uint64_t count, uint64_t ofValue) const;

    std::string kind_;
    std::string file_ = "a model"; // that it was read from
    std::vector<Block> blocks_;
};

} // namespace irradia
