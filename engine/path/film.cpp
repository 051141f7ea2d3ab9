#include "engine/path/film.h"

#include "engine/path/scene_bindings.h"
#include "kernels/path.h"
#include <algorithm>
#include <limits>

namespace irradia {
namespace {

// Of a part: 0.75 GiB of layers, where devices allocate 1 GiB at least.
constexpr uint32_t kMostPixels = 1u << 24;

// Pixels of a wave at most, and of a part: whole waves.
uint32_t runOf(bool isCpu, const PathTracerOptions& options) {
    return Waves::pixelsOfWave(options.pixels(), WaveBuffers::largestWave(isCpu, options));
}
uint32_t partOf(bool isCpu, const PathTracerOptions& options) {
    const uint32_t run = runOf(isCpu, options);
    return std::max(kMostPixels / run, 1u) * run;
}

// Calls visit(const glm::vec4*) with the vectors of each pixel in turn; reads some of them at a time.
template <uint32_t vectors, typename Visit>
void forEachPixel(Device& device, const std::vector<Buffer>& parts, const Visit& visit) {
    constexpr uint64_t kBytes = vectors * sizeof(glm::vec4), kTogether = kBytes << 18;
    for (const Buffer& part : parts)
        for (uint64_t offset = 0; offset < part.bytes(); offset += kTogether) {
            const uint64_t bytes = std::min(kTogether, part.bytes() - offset);
            const auto values = download<glm::vec4>(device, part, bytes / sizeof(glm::vec4), offset);
            for (size_t i = 0; i < values.size(); i += vectors) visit(&values[i]);
        }
}

} // namespace

std::vector<Device::PlannedBuffer> Film::planned(bool isCpu, const PathTracerOptions& options) {
    const uint32_t run = runOf(isCpu, options), part = partOf(isCpu, options);
    std::vector<Device::PlannedBuffer> list{{"sample sums", uint64_t{run} * 16}};
    const auto addParts = [&](const char* name, uint64_t bytes) {
        for (uint64_t first = 0; first < options.pixels(); first += part)
            list.push_back({name, std::min<uint64_t>(part, options.pixels() - first) * bytes, run * bytes});
    };
    addParts("film", gpu::kFilmVectors * 16);
    if (options.layers) addParts("layers", gpu::kLayerVectors * 16);
    return list;
}

Film::Film(Device& device, const GpuScene& scene, const PathTracerOptions& options)
    : device_(device)
    , scene_(scene)
    , options_(options)
    , update_(device, kernels::update_film, fittedTo(scene.needs, options))
    , recordLayers_(device, kernels::record_layers, fittedTo(scene.needs, options))
    , pixelsOfPart_(partOf(device.isCpu(), options)) {
    for (const Device::PlannedBuffer& buffer : planned(device.isCpu(), options)) {
        Buffer made(device, buffer.name, buffer.bytes);
        if (buffer.name == "sample sums")
            sampleSums_ = std::move(made);
        else
            (buffer.name == "film" ? pixels_ : layers_).push_back(std::move(made));
    }
}

BufferRange Film::ofPixels(const std::vector<Buffer>& parts, uint32_t vectors, const Wave& wave) const {
    const uint64_t bytes = uint64_t{vectors} * 16;
    return {parts[wave.firstPixel / pixelsOfPart_], wave.firstPixel % pixelsOfPart_ * bytes,
            wave.pixels * bytes};
}

void Film::add(FrameGraph& graph, const WaveBuffers& buffers, const Wave& wave) const {
    // Of a frame's samples of a pixel the first alone may train.
    const uint32_t samples = options_.view == gpu::kViewTrainingDensity ? 1 : options_.samplesPerFrame;
    const uint32_t part =
        (wave.firstSample == 0 ? gpu::kFirstSamples : 0u) | (wave.isLast ? gpu::kLastSamples : 0u);
    graph.pass(update_)
        .read(buffers.radiance)
        .readWrite(sampleSums_)
        .readWrite(ofPixels(pixels_, gpu::kFilmVectors, wave))
        .push(
            gpu::FilmParams{wave.pixels, wave.log2Samples, part, frames_, 1.0f / static_cast<float>(samples)})
        .dispatch(wave.pixels);
    graph.cut();
}

void Film::recordLayers(FrameGraph& graph, const WaveBuffers& buffers, const Buffer& constants,
                        const Wave& wave, const gpu::WaveParams& params) const {
    if (layers_.empty()) return;
    Pass pass = graph.pass(recordLayers_);
    pass.read(constants)
        .read(buffers.rays[0])
        .read(buffers.hits)
        .readWrite(ofPixels(layers_, gpu::kLayerVectors, wave));
    readSurfaces(pass, scene_).push(params).dispatch(wave.pixels);
}

void Film::forget(FrameGraph& graph) {
    for (const Buffer& part : layers_) graph.fill(part, 0);
    frames_ = 0;
}

FilmImage Film::read() const {
    FilmImage image;
    image.width = static_cast<int>(options_.width);
    image.height = static_cast<int>(options_.height);
    image.frames = frames_;
    image.samplesPerFrame = options_.samplesPerFrame;
    image.reserve(options_.pixels(), frames_ >= 2, options_.layers);
    const float n = static_cast<float>(frames_);
    forEachPixel<gpu::kFilmVectors>(device_, pixels_, [&](const glm::vec4* p) {
        image.mean.emplace_back(p[0]);
        if (frames_ >= 2) image.variance.push_back(glm::vec3(p[1]) / (n * (n - 1.0f)));
    });
    forEachPixel<gpu::kLayerVectors>(device_, layers_, [&](const glm::vec4* s) {
        const float hits = std::max(s[0].w, 1.0f);
        image.albedo.push_back(glm::vec3(s[0]) / hits);
        image.normal.push_back(glm::vec3(s[1]) / hits);
        const glm::dvec3 position = glm::dvec3(glm::vec3(s[2])) / double(hits) + scene_.origin;
        image.position.push_back(s[0].w > 0 ? glm::vec3(position) : glm::vec3(0.0f));
        image.depth.push_back(s[0].w > 0 ? s[1].w / hits : std::numeric_limits<float>::infinity());
    });
    return image;
}

} // namespace irradia
