// PNG through libpng, which reports errors by longjmp: the functions it may leave that way hold plain data
// only.
#include "engine/error.h"
#include "engine/image/decode.h"
#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <png.h>

namespace irradia {
namespace {

// Deflate emits at most 258 bytes for 2 bits (RFC 1951), 1032 for one byte.
constexpr uint64_t kMaxDeflateRatio = 1032;

struct Message {
    char text[160] = "";
};

[[noreturn]] void onError(png_structp png, png_const_charp text) {
    auto* message = static_cast<Message*>(png_get_error_ptr(png));
    std::snprintf(message->text, sizeof message->text, "%s", text);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

// ---- reading

struct Source {
    const uint8_t* bytes;
    size_t size;
    size_t position;
};

void readBytes(png_structp png, png_bytep out, size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->size - source->position) png_error(png, "the data end too early");
    std::memcpy(out, source->bytes + source->position, count);
    source->position += count;
}

class Reader {
public:
    explicit Reader(std::span<const uint8_t> bytes)
        : source_{bytes.data(), bytes.size(), 0} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, onError, onWarning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    const char* message() const { return message_.text; }
    uint32_t width() const { return png_get_image_width(png_, info_); }
    uint32_t height() const { return png_get_image_height(png_, info_); }

    // Bytes of the picture before compression.
    uint64_t storedBytes() const {
        const uint64_t bits = uint64_t{png_get_bit_depth(png_, info_)} * png_get_channels(png_, info_);
        return (bits * width() + 7) / 8 * height();
    }

    bool readHeader() {
        if (!info_ || setjmp(png_jmpbuf(png_))) return false;
        png_set_read_fn(png_, &source_, readBytes);
        png_set_user_limits(png_, PNG_UINT_31_MAX,
                            PNG_UINT_31_MAX); // checkDecodedSize has the better sentence
        png_read_info(png_, info_);
        return true;
    }

    bool readRgba(uint8_t* out) {
        if (setjmp(png_jmpbuf(png_))) return false;
        convertToRgba8();
        readPasses(out);
        png_read_end(png_, nullptr);
        return true;
    }

private:
    // Colour space chunks are ignored, as glTF 2.0 (3.8.2) asks.
    void convertToRgba8() {
        png_set_expand(png_);   // palette, 1-4 bit grey and tRNS
        png_set_scale_16(png_); // round(v / 257)
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    }

    void readPasses(uint8_t* out) {
        const int passes = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        if (png_get_rowbytes(png_, info_) != size_t{4} * width()) png_error(png_, "unexpected pixel format");
        for (int pass = 0; pass < passes; ++pass)
            for (uint32_t y = 0; y < height(); ++y)
                png_read_row(png_, out + size_t{4} * width() * y, nullptr);
    }

    Message message_;
    Source source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

// ---- writing

// Keeps exceptions out of libpng's frames.
void appendBytes(png_structp png, png_bytep bytes, size_t count) {
    auto* out = static_cast<std::vector<uint8_t>*>(png_get_io_ptr(png));
    bool appended = true;
    try {
        out->insert(out->end(), bytes, bytes + count);
    } catch (const std::bad_alloc&) {
        appended = false;
    }
    if (!appended) png_error(png, "out of memory");
}

void flushNothing(png_structp) {}

class Writer {
public:
    Writer() {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, onError, onWarning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
    }
    ~Writer() { png_destroy_write_struct(&png_, &info_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    const char* message() const { return message_.text; }

    bool write(const Rgba8Image& image, bool alpha, std::vector<uint8_t>& out) {
        if (!info_ || setjmp(png_jmpbuf(png_))) return false;
        png_set_write_fn(png_, &out, appendBytes, flushNothing);
        png_set_IHDR(png_, info_, static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height), 8,
                     alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        png_write_info(png_, info_);
        if (!alpha) png_set_filler(png_, 0, PNG_FILLER_AFTER);
        for (int y = 0; y < image.height; ++y)
            png_write_row(png_, image.pixels.data() + size_t{4} * image.width * y);
        png_write_end(png_, nullptr);
        return true;
    }

private:
    Message message_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

bool hasTransparency(const Rgba8Image& image) {
    for (size_t i = 3; i < image.pixels.size(); i += 4)
        if (image.pixels[i] != 255) return true;
    return false;
}

} // namespace

Rgba8Image decodePng(std::span<const uint8_t> bytes, const std::string& name) {
    Reader reader(bytes);
    if (!reader.readHeader()) fail(ExitCode::BadData, "{}: not a usable PNG: {}", name, reader.message());
    checkDecodedSize(reader.width(), reader.height(), name);
    if (reader.storedBytes() / kMaxDeflateRatio > bytes.size())
        fail(ExitCode::BadData, "{}: {} bytes of PNG cannot hold {} x {} pixels", name, bytes.size(),
             reader.width(), reader.height());
    Rgba8Image image{static_cast<int>(reader.width()), static_cast<int>(reader.height()), {}};
    image.pixels.resize(size_t{4} * reader.width() * reader.height());
    if (!reader.readRgba(image.pixels.data()))
        fail(ExitCode::BadData, "{}: damaged PNG: {}", name, reader.message());
    return image;
}

std::vector<uint8_t> encodePng(const Rgba8Image& image) {
    if (image.width <= 0 || image.height <= 0 ||
        image.pixels.size() != size_t{4} * image.width * image.height)
        fail(ExitCode::Internal, "a PNG of {} x {} pixels needs 4 bytes each, got {} bytes", image.width,
             image.height, image.pixels.size());
    std::vector<uint8_t> bytes;
    Writer writer;
    if (!writer.write(image, hasTransparency(image), bytes))
        fail(ExitCode::Internal, "a PNG of {} x {} pixels cannot be encoded: {}", image.width, image.height,
             writer.message());
    return bytes;
}

void writePng(const std::filesystem::path& file, const Rgba8Image& image) {
    writeFileAtomically(file, encodePng(image));
}

} // namespace irradia
