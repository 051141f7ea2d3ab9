#include "engine/error.h"
#include "engine/image/atomic_file.h"
#include "engine/image/image.h"
#include "engine/image/read_file.h"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <exception>

namespace irradia {
namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
constexpr uint64_t kMaxValues = uint64_t{1} << 30; // over all channels: 4 GiB

// Hands OpenEXR's bytes to an AtomicFile. OutputFile's destructor still writes and swallows exceptions, so
// the first failure is kept and thrown by finish().
class AtomicStream : public Imf::OStream {
public:
    explicit AtomicStream(const std::filesystem::path& file)
        : OStream(file.c_str())
        , file_(file) {}

    void write(const char bytes[], int count) override {
        guarded([&] { file_.write({reinterpret_cast<const uint8_t*>(bytes), static_cast<size_t>(count)}); });
    }
    void seekp(uint64_t position) override {
        guarded([&] { file_.seek(position); });
    }
    uint64_t tellp() override {
        uint64_t position = 0;
        guarded([&] { position = file_.position(); });
        return position;
    }
    void rethrowFailure() const {
        if (failure_) std::rethrow_exception(failure_);
    }
    void finish() {
        rethrowFailure();
        file_.commit();
    }

private:
    template <typename Action>
    void guarded(Action action) {
        try {
            action();
        } catch (...) {
            if (!failure_) failure_ = std::current_exception();
            throw;
        }
    }

    AtomicFile file_;
    std::exception_ptr failure_;
};

void checkBeforeWriting(const std::filesystem::path& file, const LayeredImage& image) {
    if (image.width <= 0 || image.height <= 0 || image.channels.empty())
        fail(ExitCode::Internal, "{}: an EXR needs pixels and channels", file.string());
    for (const auto& [name, values] : image.channels)
        if (values.size() != size_t(image.width) * size_t(image.height))
            fail(ExitCode::Internal, "{}: channel {} holds {} values, not {} x {}", file.string(), name,
                 values.size(), image.width, image.height);
}

// OpenEXR multiplies row vectors, GLSL column vectors: a row of the one is a column of the other.
template <typename To, typename From>
To matrixAs(const From& matrix) {
    To result;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) result[i][k] = matrix[i][k];
    return result;
}

Imf::Header makeHeader(const LayeredImage& image) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& entry : image.channels) header.channels().insert(entry.first, Imf::Channel(Imf::FLOAT));
    for (const auto& [name, value] : image.attributes) header.insert(name, Imf::StringAttribute(value));
    for (const auto& [name, value] : image.matrices)
        header.insert(name, Imf::M44fAttribute(matrixAs<Imath::M44f>(value)));
    Imf::addChromaticities(header, Imf::Chromaticities()); // of Rec. 709
    return header;
}

Imf::Slice floatSlice(const std::vector<float>& values, const Imath::Box2i& window) {
    return Imf::Slice::Make(Imf::FLOAT, values.data(), window);
}

// Width and height, or an Error: from here on their product fits.
void readSize(const Imath::Box2i& window, LayeredImage& image) {
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width <= 0 || height <= 0) fail(ExitCode::BadData, "{}: the picture is empty", image.name);
    if (static_cast<uint64_t>(width) > kMaxPixels / static_cast<uint64_t>(height))
        fail(ExitCode::BadData, "{}: {} x {} pixels are more than the {} allowed", image.name, width, height,
             kMaxPixels);
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
}

void readAttributes(const Imf::Header& header, LayeredImage& image) {
    for (auto it = header.begin(); it != header.end(); ++it) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
            image.attributes[it.name()] = text->value();
        if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&it.attribute()))
            image.matrices[it.name()] = matrixAs<glm::mat4>(matrix->value());
    }
}

// Half and unsigned channels become float on the way.
void readChannels(Imf::InputFile& file, LayeredImage& image) {
    const Imath::Box2i window = file.header().dataWindow();
    const Imf::ChannelList& list = file.header().channels();
    const uint64_t pixels = static_cast<uint64_t>(image.width) * static_cast<uint64_t>(image.height);
    uint64_t count = 0;
    for (auto it = list.begin(); it != list.end(); ++it) ++count;
    if (count > kMaxValues / pixels)
        fail(ExitCode::BadData, "{}: {} channels of {} x {} pixels are more than the {} values allowed",
             image.name, count, image.width, image.height, kMaxValues);
    Imf::FrameBuffer frame;
    for (auto it = list.begin(); it != list.end(); ++it) {
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
            fail(ExitCode::BadData, "{}: channel {} is subsampled, which is not supported", image.name,
                 it.name());
        auto& values = image.channels[it.name()];
        values.resize(pixels);
        frame.insert(it.name(), floatSlice(values, window));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
}

} // namespace

void writeExr(const std::filesystem::path& file, const LayeredImage& image) {
    checkBeforeWriting(file, image);
    AtomicStream stream(file);
    try {
        const Imf::Header header = makeHeader(image);
        Imf::FrameBuffer frame;
        for (const auto& [name, values] : image.channels)
            frame.insert(name, floatSlice(values, header.dataWindow()));
        Imf::OutputFile output(stream, header);
        output.setFrameBuffer(frame);
        output.writePixels(image.height);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        stream.rethrowFailure();
        fail(ExitCode::Internal, "{}: cannot be encoded as OpenEXR: {}", file.string(), error.what());
    }
    stream.finish();
}

LayeredImage readExr(const std::filesystem::path& file) {
    requireFile(file);
    LayeredImage image;
    image.name = file.string();
    try {
        Imf::InputFile input(file.c_str(), 0);
        readSize(input.header().dataWindow(), image);
        readAttributes(input.header(), image);
        readChannels(input, image);
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
