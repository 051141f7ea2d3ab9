// Radiance RGBE (Ward, "Real Pixels", Graphics Gems II, 1991): a text header, then scanlines that are plain,
// run-length coded by repeated pixels (old) or by component (new).
#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/image/read_file.h"
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace irradia {
namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
constexpr size_t kMaxHeaderLine = 4096;

using Rgbe = std::array<uint8_t, 4>;

class Parser {
public:
    Parser(std::span<const uint8_t> bytes, std::string name)
        : bytes_(bytes)
        , name_(std::move(name)) {}

    LayeredImage parse() {
        LayeredImage image;
        image.name = name_;
        readHeader();
        readResolution(image);
        auto& r = image.channels["R"];
        auto& g = image.channels["G"];
        auto& b = image.channels["B"];
        std::vector<Rgbe> scanline(static_cast<size_t>(image.width));
        // Grows with what was really there: a size claimed by a short file costs nothing.
        for (int y = 0; y < image.height; ++y) {
            readScanline(scanline);
            for (const Rgbe& pixel : scanline) {
                const float scale = pixel[3] ? std::ldexp(1.0f, pixel[3] - (128 + 8)) : 0.0f;
                r.push_back(static_cast<float>(pixel[0]) * scale);
                g.push_back(static_cast<float>(pixel[1]) * scale);
                b.push_back(static_cast<float>(pixel[2]) * scale);
            }
        }
        return image;
    }

private:
    uint8_t byte() {
        if (position_ == bytes_.size())
            fail(ExitCode::BadData, "{}: damaged HDR: the data end too early", name_);
        return bytes_[position_++];
    }

    Rgbe pixel() {
        Rgbe value;
        for (uint8_t& component : value) component = byte();
        return value;
    }

    std::string line() {
        std::string text;
        for (char c; (c = static_cast<char>(byte())) != '\n'; text += c)
            if (text.size() == kMaxHeaderLine)
                fail(ExitCode::BadData, "{}: not a usable HDR: endless header", name_);
        if (!text.empty() && text.back() == '\r') text.pop_back();
        return text;
    }

    // Variables up to an empty line. EXPOSURE is left unapplied, as other renderers do.
    void readHeader() {
        if (bytes_.size() < 2 || bytes_[0] != '#' || bytes_[1] != '?')
            fail(ExitCode::BadData, "{}: not a Radiance HDR picture", name_);
        line();
        for (std::string text = line(); !text.empty(); text = line()) {
            constexpr std::string_view kFormat = "FORMAT=";
            if (text.starts_with(kFormat) && text.substr(kFormat.size()) != "32-bit_rle_rgbe")
                fail(ExitCode::BadData, "{}: HDR format {} is not supported", name_,
                     text.substr(kFormat.size()));
        }
    }

    void readResolution(LayeredImage& image) {
        const std::string text = line();
        int width = 0;
        int height = 0;
        int used = 0;
        if (std::sscanf(text.c_str(), "-Y %9d +X %9d%n", &height, &width, &used) != 2 ||
            static_cast<size_t>(used) != text.size())
            fail(ExitCode::BadData, "{}: HDR size line \"{}\" is not \"-Y height +X width\"", name_, text);
        if (width <= 0 || height <= 0) fail(ExitCode::BadData, "{}: the picture is empty", name_);
        if (static_cast<uint64_t>(width) * static_cast<uint64_t>(height) > kMaxPixels)
            fail(ExitCode::BadData, "{}: {} x {} pixels are more than the {} allowed", name_, width, height,
                 kMaxPixels);
        image.width = width;
        image.height = height;
    }

    void readScanline(std::vector<Rgbe>& scanline) {
        const size_t width = scanline.size();
        const Rgbe first = pixel();
        const bool byComponent =
            width >= 8 && width < 0x8000 && first[0] == 2 && first[1] == 2 && first[2] < 128;
        if (!byComponent) return readPixelRuns(first, scanline);
        if (size_t{first[2]} * 256 + first[3] != width)
            fail(ExitCode::BadData, "{}: damaged HDR: a scanline of {} pixels in a picture {} wide", name_,
                 first[2] * 256 + first[3], width);
        for (size_t component = 0; component < 4; ++component) readComponent(component, scanline);
    }

    // (1, 1, 1, n) repeats the pixel before it n times; runs in a row are the digits of n in base 256, lowest
    // first.
    void readPixelRuns(Rgbe value, std::vector<Rgbe>& scanline) {
        size_t x = 0;
        unsigned shift = 0;
        while (true) {
            if (value[0] == 1 && value[1] == 1 && value[2] == 1) {
                const uint64_t count = shift < 32 ? uint64_t{value[3]} << shift : scanline.size() + 1;
                if (x == 0 || count > scanline.size() - x) failRun();
                std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(x), count, scanline[x - 1]);
                x += count;
                shift += 8;
            } else {
                scanline[x++] = value;
                shift = 0;
            }
            if (x == scanline.size()) return;
            value = pixel();
        }
    }

    // A count above 128 repeats one value count - 128 times, else count values follow.
    void readComponent(size_t component, std::vector<Rgbe>& scanline) {
        for (size_t x = 0; x < scanline.size();) {
            const uint8_t code = byte();
            const bool repeat = code > 128;
            const size_t count = repeat ? code - 128u : code;
            if (count == 0 || count > scanline.size() - x) failRun();
            uint8_t value = byte();
            for (size_t i = 0; i < count; ++i) {
                if (i > 0 && !repeat) value = byte();
                scanline[x++][component] = value;
            }
        }
    }

    [[noreturn]] void failRun() const {
        fail(ExitCode::BadData, "{}: damaged HDR: a run does not fit its scanline", name_);
    }

    std::span<const uint8_t> bytes_;
    std::string name_;
    size_t position_ = 0;
};

} // namespace

LayeredImage readHdr(const std::filesystem::path& file) {
    const std::vector<uint8_t> bytes = readFile(file);
    return Parser(bytes, file.string()).parse();
}

} // namespace irradia
