#include "nrc/learning/model_file.h"

#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/image/read_file.h"
#include "nrc/learning/checksum.h"
#include <algorithm>
#include <bit>

namespace irradia {
namespace {

static_assert(std::endian::native == std::endian::little, "models are stored as they are in memory");

constexpr std::string_view kMagic = "IRRADNET";
constexpr uint32_t kVersion = 2;

class Writer {
public:
    void raw(const void* from, size_t bytes) {
        const auto* begin = static_cast<const uint8_t*>(from);
        bytes_.insert(bytes_.end(), begin, begin + bytes);
    }
    template <typename T>
    void value(const T& v) {
        raw(&v, sizeof v);
    }
    void block(const void* from, size_t bytes) {
        value(uint64_t(bytes));
        raw(from, bytes);
    }
    std::vector<uint8_t> finish() {
        value(checksum<uint8_t>(bytes_));
        return std::move(bytes_);
    }

private:
    std::vector<uint8_t> bytes_;
};

class Reader {
public:
    Reader(std::span<const uint8_t> bytes, const std::filesystem::path& file)
        : rest_(bytes)
        , file_(file) {}

    std::span<const uint8_t> raw(uint64_t bytes) {
        if (bytes > rest_.size()) fail(ExitCode::BadData, "{}: the model is cut off", file_.string());
        const auto part = rest_.first(bytes);
        rest_ = rest_.subspan(bytes);
        return part;
    }
    template <typename T>
    T value() {
        T v;
        std::memcpy(&v, raw(sizeof v).data(), sizeof v);
        return v;
    }
    std::span<const std::byte> block() { return std::as_bytes(raw(value<uint64_t>())); }
    std::string text() {
        const auto part = raw(value<uint64_t>());
        return {part.begin(), part.end()};
    }

private:
    std::span<const uint8_t> rest_;
    const std::filesystem::path& file_;
};

void checkHead(std::span<const uint8_t> bytes, const std::filesystem::path& file) {
    if (bytes.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin()))
        fail(ExitCode::BadData, "{}: is no model of this program", file.string());
    Reader reader(bytes.subspan(kMagic.size()), file);
    if (const auto version = reader.value<uint32_t>(); version != kVersion)
        fail(ExitCode::BadData, "{}: is a model of version {}, this program reads version {}", file.string(),
             version, kVersion);
}

} // namespace

void ModelFile::write(const std::filesystem::path& file) const {
    Writer writer;
    writer.raw(kMagic.data(), kMagic.size());
    writer.value(kVersion);
    writer.block(kind_.data(), kind_.size());
    writer.value(uint64_t(blocks_.size()));
    for (const Block& block : blocks_) {
        writer.block(block.name.data(), block.name.size());
        writer.block(block.bytes.data(), block.bytes.size());
    }
    writeFileAtomically(file, writer.finish());
}

ModelFile ModelFile::read(const std::filesystem::path& file, const std::string& kind) {
    ModelFile model = read(file);
    if (model.kind_ != kind)
        model.refuse(fmt::format("is a model of kind '{}', wanted is one of kind '{}'", model.kind_, kind));
    return model;
}

ModelFile ModelFile::read(const std::filesystem::path& file) {
    const std::vector<uint8_t> bytes = readFile(file);
    checkHead(bytes, file);
    Reader reader(std::span<const uint8_t>(bytes).subspan(kMagic.size() + sizeof kVersion), file);
    ModelFile model(reader.text());
    model.file_ = file.string();
    const auto count = reader.value<uint64_t>();
    for (uint64_t i = 0; i < count; ++i) {
        const std::string name = reader.text();
        const auto content = reader.block();
        if (model.has(name)) model.refuse(fmt::format("holds the block '{}' twice", name));
        model.addBytes(name, content);
    }
    if (reader.value<uint32_t>() !=
        checksum<uint8_t>(std::span(bytes).first(bytes.size() - sizeof(uint32_t))))
        model.refuse("the model is damaged (its checksum differs)");
    return model;
}

uint32_t ModelFile::version() {
    return kVersion;
}

std::vector<ModelFile::BlockSize> ModelFile::blocks() const {
    std::vector<BlockSize> sizes;
    for (const Block& block : blocks_) sizes.push_back({block.name, block.bytes.size()});
    return sizes;
}

void ModelFile::addBytes(const std::string& name, std::span<const std::byte> bytes) {
    if (has(name)) fail(ExitCode::Internal, "model: has two blocks '{}'", name);
    blocks_.push_back({name, {bytes.begin(), bytes.end()}});
}

bool ModelFile::has(std::string_view name) const {
    return std::ranges::find(blocks_, name, &Block::name) != blocks_.end();
}

const ModelFile::Block& ModelFile::find(std::string_view name) const {
    const auto found = std::ranges::find(blocks_, name, &Block::name);
    if (found == blocks_.end()) refuse(fmt::format("holds no block '{}'", name));
    return *found;
}

std::span<const std::byte> ModelFile::block(const std::string& name, uint64_t count, uint64_t ofValue) const {
    const Block& found = find(name);
    if (found.bytes.size() != count * ofValue)
        refuse(fmt::format("block '{}' holds {} bytes, wanted are {}", name, found.bytes.size(),
                           count * ofValue));
    return found.bytes;
}

std::string ModelFile::text(const std::string& name) const {
    const Block& found = find(name);
    std::string text(found.bytes.size(), '\0');
    std::memcpy(text.data(), found.bytes.data(), text.size());
    return text;
}

void ModelFile::refuse(const std::string& what) const {
    fail(ExitCode::BadData, "{}: {}", file_, what);
}

} // namespace irradia
