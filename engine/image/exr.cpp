#include "engine/error.h"
#include "engine/image/atomic_file.h"
#include "engine/image/image.h"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <exception>

namespace irradia {
namespace {

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
Imath::M44f toImath(const glm::mat4& matrix) {
    Imath::M44f result;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) result[i][k] = matrix[i][k];
    return result;
}

Imf::Header makeHeader(const LayeredImage& image) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& entry : image.channels) header.channels().insert(entry.first, Imf::Channel(Imf::FLOAT));
    for (const auto& [name, value] : image.attributes) header.insert(name, Imf::StringAttribute(value));
    for (const auto& [name, value] : image.matrices) header.insert(name, Imf::M44fAttribute(toImath(value)));
    if (image.toRec709 == glm::mat3(1.0f)) Imf::addChromaticities(header, Imf::Chromaticities());
    return header;
}

Imf::Slice floatSlice(const std::vector<float>& values, const Imath::Box2i& window) {
    return Imf::Slice::Make(Imf::FLOAT, values.data(), window);
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

} // namespace irradia
