// Reading OpenEXR: of a file with several parts the one that holds the layer, cropped or extended with black
// to its display window.
#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/image/primaries.h"
#include "engine/image/read_file.h"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <algorithm>

namespace irradia {
namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
constexpr uint64_t kMaxValues = uint64_t{1} << 30; // over all channels: 4 GiB

// A display window of many pixels may be this many times what the file holds: beyond it the black around is
// no crop but a broken header.
constexpr uint64_t kMaxBlack = 256;
constexpr uint64_t kManyPixels = uint64_t{1} << 24;

// A part of a file, and what its channels are called in front of their own names.
struct PartChoice {
    int part = -1;
    std::string prefix;
};

bool isDeep(const Imf::Header& header) {
    return header.hasType() && Imf::isDeepData(header.type());
}

bool hasChannels(const Imf::Header& header, const std::string& layer, std::string_view names) {
    const std::string prefix = layer.empty() ? "" : layer + ".";
    return std::ranges::all_of(
        names, [&](char name) { return header.channels().findChannel(prefix + name) != nullptr; });
}

bool hasColour(const Imf::Header& header, const std::string& layer) {
    return hasChannels(header, layer, "RGB") || hasChannels(header, layer, "Y");
}

// The layer as channels of the part are called without its name: "P" and "P.L" of a part P are "" and "L".
bool insidePart(const Imf::Header& header, const std::string& layer, std::string& inside) {
    if (!header.hasName() || !layer.starts_with(header.name())) return false;
    const size_t length = header.name().size();
    inside = layer.size() == length ? "" : layer.substr(length + 1);
    return layer.size() == length || layer[length] == '.';
}

// "R, G, B in part 'rgb'; Z in part 'depth'", no more than fits a line or two.
std::string contents(const Imf::MultiPartInputFile& file) {
    std::string text;
    for (int part = 0; part < file.parts() && text.size() < 200; ++part) {
        const Imf::Header& header = file.header(part);
        if (part > 0) text += "; ";
        std::string names;
        for (auto it = header.channels().begin(); it != header.channels().end() && names.size() < 100; ++it)
            names += (names.empty() ? "" : ", ") + std::string(it.name());
        text += names;
        if (header.hasName()) text += " in part '" + header.name() + "'";
    }
    return text;
}

PartChoice choosePart(const Imf::MultiPartInputFile& file, const std::string& layer,
                      const std::string& name) {
    int firstFlat = -1;
    for (int part = 0; part < file.parts(); ++part) {
        if (isDeep(file.header(part))) continue;
        if (firstFlat < 0) firstFlat = part;
        if (hasColour(file.header(part), layer)) return {part, ""};
    }
    std::string inside;
    for (int part = 0; part < file.parts(); ++part)
        if (const Imf::Header& header = file.header(part);
            !isDeep(header) && insidePart(header, layer, inside) && hasColour(header, inside))
            return {part, header.name() + "."};
    if (firstFlat < 0) fail(ExitCode::BadData, "{}: deep pictures are not supported", name);
    if (!layer.empty())
        fail(ExitCode::BadData, "{}: has no layer '{}' with R, G, B or Y, only {}", name, layer,
             contents(file));
    return {firstFlat, ""};
}

struct Size {
    int64_t width, height;
    uint64_t pixels() const { return static_cast<uint64_t>(width) * static_cast<uint64_t>(height); }
};

Size sizeOf(const Imath::Box2i& window, const std::string& name) {
    const Size size{int64_t{window.max.x} - window.min.x + 1, int64_t{window.max.y} - window.min.y + 1};
    if (size.width <= 0 || size.height <= 0) fail(ExitCode::BadData, "{}: the picture is empty", name);
    if (static_cast<uint64_t>(size.width) > kMaxPixels / static_cast<uint64_t>(size.height))
        fail(ExitCode::BadData, "{}: {} x {} pixels are more than the {} allowed", name, size.width,
             size.height, kMaxPixels);
    return size;
}

// From the data window to the display window: black where a file holds nothing.
class Windows {
public:
    Windows(const Imf::Header& header, const std::string& name)
        : data_(header.dataWindow())
        , display_(header.displayWindow())
        , dataSize_(sizeOf(data_, name))
        , displaySize_(sizeOf(display_, name)) {
        if (!data_.intersects(display_))
            fail(ExitCode::BadData, "{}: its pixels lie outside its display window", name);
        if (displaySize_.pixels() > std::max(kManyPixels, kMaxBlack * dataSize_.pixels()))
            fail(ExitCode::BadData, "{}: {} x {} pixels are shown, of which the file holds {} x {}", name,
                 displaySize_.width, displaySize_.height, dataSize_.width, dataSize_.height);
    }

    const Imath::Box2i& data() const { return data_; }
    Size dataSize() const { return dataSize_; }
    Size displaySize() const { return displaySize_; }

    std::vector<float> displayed(std::vector<float> values) const {
        if (data_ == display_) return values;
        std::vector<float> result(displaySize_.pixels(), 0.0f);
        const int left = std::max(data_.min.x, display_.min.x), right = std::min(data_.max.x, display_.max.x);
        for (int y = std::max(data_.min.y, display_.min.y); y <= std::min(data_.max.y, display_.max.y); ++y)
            std::copy_n(values.begin() + offset(data_, dataSize_, left, y), right - left + 1,
                        result.begin() + offset(display_, displaySize_, left, y));
        return result;
    }

private:
    static int64_t offset(const Imath::Box2i& window, const Size& size, int x, int y) {
        return (int64_t{y} - window.min.y) * size.width + x - window.min.x;
    }

    Imath::Box2i data_, display_;
    Size dataSize_, displaySize_;
};

// A row of OpenEXR's matrix is a column of GLSL's.
glm::mat4 fromImath(const Imath::M44f& matrix) {
    glm::mat4 result;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) result[i][k] = matrix[i][k];
    return result;
}

void readAttributes(const Imf::Header& header, LayeredImage& image) {
    for (auto it = header.begin(); it != header.end(); ++it) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
            image.attributes[it.name()] = text->value();
        if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&it.attribute()))
            image.matrices[it.name()] = fromImath(matrix->value());
    }
    for (const char* ofParts : {"name", "type"}) image.attributes.erase(ofParts);
    if (Imf::hasChromaticities(header)) image.toRec709 = matrixToRec709(Imf::chromaticities(header));
}

// Luminance and subsampled chroma, as OpenEXR's RGBA interface turns them into R, G, B (halves).
void readLuminanceChroma(const std::filesystem::path& file, const Windows& windows, LayeredImage& image) {
    Imf::RgbaInputFile input(file.c_str());
    const Size size = windows.dataSize();
    std::vector<Imf::Rgba> pixels(size.pixels());
    const Imath::V2i& first = windows.data().min;
    input.setFrameBuffer(pixels.data() - (int64_t{first.y} * size.width + first.x), 1,
                         static_cast<size_t>(size.width));
    input.readPixels(first.y, windows.data().max.y);
    const auto channel = [&](half Imf::Rgba::*component) {
        std::vector<float> values(pixels.size());
        std::ranges::transform(pixels, values.begin(),
                               [&](const Imf::Rgba& pixel) { return float(pixel.*component); });
        return windows.displayed(std::move(values));
    };
    image.channels["R"] = channel(&Imf::Rgba::r);
    image.channels["G"] = channel(&Imf::Rgba::g);
    image.channels["B"] = channel(&Imf::Rgba::b);
}

// Half and unsigned channels become float on the way.
void readChannels(Imf::InputPart part, const std::string& prefix, const Windows& windows,
                  LayeredImage& image) {
    const Imf::ChannelList& list = part.header().channels();
    uint64_t count = 0;
    for (auto it = list.begin(); it != list.end(); ++it) ++count;
    const Size size = windows.dataSize(), shown = windows.displaySize();
    if (count > kMaxValues / std::max(size.pixels(), shown.pixels()))
        fail(ExitCode::BadData, "{}: {} channels of {} x {} pixels are more than the {} values allowed",
             image.name, count, size.width, size.height, kMaxValues);
    Imf::FrameBuffer frame;
    for (auto it = list.begin(); it != list.end(); ++it) {
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
            fail(ExitCode::BadData, "{}: channel {} is subsampled, which is not supported", image.name,
                 it.name());
        auto& values = image.channels[prefix + it.name()];
        values.resize(size.pixels());
        frame.insert(it.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), windows.data()));
    }
    part.setFrameBuffer(frame);
    part.readPixels(windows.data().min.y, windows.data().max.y);
    for (auto& [name, values] : image.channels) values = windows.displayed(std::move(values));
}

} // namespace

LayeredImage readExr(const std::filesystem::path& file, const std::string& layer) {
    requireFile(file);
    LayeredImage image;
    image.name = file.string();
    try {
        Imf::MultiPartInputFile input(file.c_str(), 0);
        const PartChoice choice = choosePart(input, layer, image.name);
        const Imf::Header& header = input.header(choice.part);
        const Windows windows(header, image.name);
        image.width = static_cast<int>(windows.displaySize().width);
        image.height = static_cast<int>(windows.displaySize().height);
        readAttributes(header, image);
        const bool isChroma = hasChannels(header, "", "Y") && header.channels().findChannel("RY") &&
                              header.channels().findChannel("BY");
        if (isChroma && input.parts() == 1)
            readLuminanceChroma(file, windows, image);
        else
            readChannels(Imf::InputPart(input, choice.part), choice.prefix, windows, image);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail(ExitCode::BadData, "{}: not a usable OpenEXR picture: {}", file.string(), error.what());
    }
    return image;
}

} // namespace irradia
