#include "nrc/learning/model_file.h"

#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/image/read_file.h"
#include "nrc/learning/checksum.h"
#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

namespace irradia {
namespace {

static_assert(std::endian::native == std::endian::little, "models are stored as they are in memory");

constexpr std::string_view kMagic = "IRRADNET";
constexpr uint32_t kVersion = 1;

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
    void text(const std::string& s) {
        value(uint64_t(s.size()));
        raw(s.data(), s.size());
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

void writeModel(const std::filesystem::path& file, const ModelFile& model) {
    Writer writer;
    writer.raw(kMagic.data(), kMagic.size());
    writer.value(kVersion);
    writer.text(model.shape);
    writer.text(model.config);
    writer.value(model.state);
    writer.value(uint64_t(model.content.size()));
    writer.raw(model.content.data(), model.content.size() * sizeof(float));
    writeFileAtomically(file, writer.finish());
}

ModelFile readModel(const std::filesystem::path& file, const std::string& shape, uint64_t contentCount) {
    const std::vector<uint8_t> bytes = readFile(file);
    checkHead(bytes, file);
    Reader reader(std::span<const uint8_t>(bytes).subspan(kMagic.size() + sizeof kVersion), file);
    ModelFile model;
    model.shape = reader.text();
    model.config = reader.text();
    model.state = reader.value<gpu::TrainingState>();
    const auto count = reader.value<uint64_t>();
    if (count > bytes.size() / sizeof(float))
        fail(ExitCode::BadData, "{}: the model is cut off", file.string());
    const auto content = reader.raw(count * sizeof(float));
    if (reader.value<uint32_t>() !=
        checksum<uint8_t>(std::span(bytes).first(bytes.size() - sizeof(uint32_t))))
        fail(ExitCode::BadData, "{}: the model is damaged (its checksum differs)", file.string());
    if (model.shape != shape)
        fail(ExitCode::BadData, "{}: holds a model of {}, wanted is one of {}", file.string(), model.shape,
             shape);
    if (count != contentCount)
        fail(ExitCode::BadData, "{}: holds {} numbers, wanted are {}", file.string(), count, contentCount);
    model.content.resize(count);
    std::memcpy(model.content.data(), content.data(), content.size());
    return model;
}

} // namespace irradia
