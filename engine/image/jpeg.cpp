// JPEG through libjpeg-turbo, which reports errors by longjmp: the functions it may leave that way hold plain
// data only.
#include "engine/error.h"
#include "engine/image/decode.h"
#include <csetjmp>
#include <cstdio>
// jpeglib.h needs <cstdio> before it.
#include <jerror.h>
#include <jpeglib.h>

namespace irradia {
namespace {

// A progressive file may repeat scans of a whole picture in a few bytes each; real ones have about ten.
constexpr int kMaxScans = 200;

struct ErrorManager {
    jpeg_error_mgr base; // first: libjpeg hands back a pointer to it
    std::jmp_buf jump;
    char text[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void onError(j_common_ptr codec) {
    auto* errors = reinterpret_cast<ErrorManager*>(codec->err);
    codec->err->format_message(codec, errors->text);
    std::longjmp(errors->jump, 1);
}

// Missing data are filled with grey by libjpeg and only warned about; here they are an error.
void onMessage(j_common_ptr codec, int level) {
    const int code = codec->err->msg_code;
    if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) onError(codec);
}

void onProgress(j_common_ptr codec) {
    const auto* decoder = reinterpret_cast<jpeg_decompress_struct*>(codec);
    if (decoder->input_scan_number <= kMaxScans) return;
    auto* errors = reinterpret_cast<ErrorManager*>(codec->err);
    std::snprintf(errors->text, sizeof errors->text, "more than %d scans", kMaxScans);
    std::longjmp(errors->jump, 1);
}

// Without the profile of a press: R = (1 - C) (1 - K), and so on. Adobe's programs, and all that write their
// marker, store 255 for no ink.
void inksToRgba(uint8_t* row, uint32_t pixels, bool isInverted) {
    for (uint8_t* p = row; p != row + size_t{4} * pixels; p += 4) {
        const unsigned flip = isInverted ? 0u : 255u;
        const unsigned unprinted = p[3] ^ flip; // of black
        for (int c = 0; c < 3; ++c) p[c] = static_cast<uint8_t>(((p[c] ^ flip) * unprinted + 127) / 255);
        p[3] = 255;
    }
}

class Reader {
public:
    Reader() {
        decoder_.err = jpeg_std_error(&errors_.base);
        errors_.base.error_exit = onError;
        errors_.base.emit_message = onMessage;
        progress_.progress_monitor = onProgress;
    }
    ~Reader() { jpeg_destroy_decompress(&decoder_); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    const char* message() const { return errors_.text; }
    uint32_t width() const { return decoder_.image_width; }
    uint32_t height() const { return decoder_.image_height; }

    bool readHeader(std::span<const uint8_t> bytes) {
        if (setjmp(errors_.jump)) return false;
        jpeg_create_decompress(&decoder_);
        decoder_.progress = &progress_;
        jpeg_mem_src(&decoder_, bytes.data(), bytes.size());
        jpeg_read_header(&decoder_, TRUE);
        return true;
    }

    // Four components are inks: libjpeg turns YCCK into CMYK, and that is turned into RGB here.
    bool readRgba(uint8_t* out) {
        if (setjmp(errors_.jump)) return false;
        decoder_.out_color_space = isCmyk() ? JCS_CMYK : JCS_EXT_RGBA;
        jpeg_start_decompress(&decoder_);
        while (decoder_.output_scanline < decoder_.output_height) {
            JSAMPROW row = out + size_t{4} * decoder_.output_width * decoder_.output_scanline;
            jpeg_read_scanlines(&decoder_, &row, 1);
            if (isCmyk()) inksToRgba(row, decoder_.output_width, decoder_.saw_Adobe_marker);
        }
        jpeg_finish_decompress(&decoder_);
        return true;
    }

private:
    bool isCmyk() const {
        return decoder_.jpeg_color_space == JCS_CMYK || decoder_.jpeg_color_space == JCS_YCCK;
    }

    jpeg_decompress_struct decoder_{};
    jpeg_progress_mgr progress_{};
    ErrorManager errors_{};
};

} // namespace

Rgba8Image decodeJpeg(std::span<const uint8_t> bytes, const std::string& name) {
    Reader reader;
    if (!reader.readHeader(bytes))
        fail(ExitCode::BadData, "{}: not a usable JPEG: {}", name, reader.message());
    checkDecodedSize(reader.width(), reader.height(), name);
    Rgba8Image image{static_cast<int>(reader.width()), static_cast<int>(reader.height()), {}};
    image.pixels.resize(size_t{4} * reader.width() * reader.height());
    if (!reader.readRgba(image.pixels.data()))
        fail(ExitCode::BadData, "{}: damaged JPEG: {}", name, reader.message());
    return image;
}

} // namespace irradia
