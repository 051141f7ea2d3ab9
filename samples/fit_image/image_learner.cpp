#include "samples/fit_image/image_learner.h"

#include "kernels/pixels.h"
#include "nrc/learning/batch_rows.h"
#include "samples/fit_image/pixels/pixels.h"
#include "shared/network.h"
#include <algorithm>
#include <bit>
#include <chrono>

namespace irradia {
namespace {

constexpr uint32_t kMaxInferRows = 1u << 16;
constexpr uint32_t kMeasuredStep = UINT32_MAX; // key of the pixels that measure() looks at
constexpr uint64_t kRecordBytes = 16;

enum Counter : uint32_t { LearnedRows, PredictedRows, Counters };

uint32_t pixelCount(const Picture& picture) {
    return picture.width * picture.height;
}

uint32_t inferRows(const Picture& picture) {
    return std::min(paddedRows(pixelCount(picture)), kMaxInferRows);
}

TrainerOptions trainerOptions(const Picture& picture, const LearnerOptions& options) {
    return {.batchRows = 1u << options.log2Batch, .inferRows = inferRows(picture), .seed = options.seed};
}

Buffer pictureBuffer(Device& device, const Picture& picture) {
    const uint64_t records = (picture.pixels.size() + gpu::kPixelsPerRecord - 1) / gpu::kPixelsPerRecord;
    Buffer buffer(device, "picture", records * kRecordBytes);
    upload<uint64_t>(device, buffer, picture.pixels);
    return buffer;
}

} // namespace

ImageLearner::ImageLearner(Device& device, const Picture& picture, const ModelConfig& config,
                           const LearnerOptions& options)
    : device_(device)
    , picture_(picture)
    , options_(options)
    , pixels_(pixelCount(picture))
    , inferRows_(inferRows(picture))
    , trainer_(device, config, 2, 3, trainerOptions(picture, options))
    , graph_(device)
    , stepGraph_(device, &profiler_)
    , drawPixels_(device, kernels::draw_pixels)
    , listPixels_(device, kernels::list_pixels)
    , pictureRecords_(pictureBuffer(device, picture))
    , counters_(device, "row counters", Counters * sizeof(uint32_t), Memory::Host)
    , batchInputs_(device, "batch inputs", kRecordBytes << options.log2Batch)
    , batchTargets_(device, "batch targets", kRecordBytes << options.log2Batch)
    , listedInputs_(device, "listed inputs", kRecordBytes * inferRows_)
    , measuredInputs_(device, "measured inputs", kRecordBytes * inferRows_)
    , results_(device, "predictions", kRecordBytes * inferRows_)
    , hostResults_(device, "predictions on the host", kRecordBytes * inferRows_, Memory::Host) {
    if (pixels_ <= kMaxInferRows) return;
    const Buffer targets(device, "measured targets", kRecordBytes * inferRows_);
    draw(graph_, static_cast<uint32_t>(std::countr_zero(inferRows_)), kMeasuredStep, measuredInputs_,
         targets);
    graph_.execute();
    for (const glm::vec4& colour : download<glm::vec4>(device, targets, inferRows_))
        measuredColours_.emplace_back(colour);
}

void ImageLearner::draw(FrameGraph& graph, uint32_t log2Rows, uint32_t step, const Buffer& inputs,
                        const Buffer& targets) {
    graph.pass(drawPixels_)
        .read(pictureRecords_)
        .write(inputs)
        .write(targets)
        .push(gpu::DrawParams{picture_.width, picture_.height, log2Rows, step, options_.seed})
        .dispatch(uint64_t{1} << log2Rows);
}

void ImageLearner::list(uint32_t first, uint32_t rows) {
    graph_.pass(listPixels_)
        .write(listedInputs_)
        .push(gpu::ListParams{picture_.width, picture_.height, first, rows})
        .dispatch(rows);
}

std::span<const glm::vec4> ImageLearner::infer(const Buffer& inputs, uint32_t rows) {
    reinterpret_cast<uint32_t*>(counters_.mapped().data())[PredictedRows] = rows;
    trainer_.infer(graph_, {counters_, PredictedRows, inferRows_}, inputs, results_);
    graph_.copy(results_, hostResults_);
    graph_.execute();
    return {reinterpret_cast<const glm::vec4*>(hostResults_.mapped().data()), rows};
}

void ImageLearner::learn(uint32_t rows) {
    const auto start = std::chrono::steady_clock::now();
    reinterpret_cast<uint32_t*>(counters_.mapped().data())[LearnedRows] = rows;
    draw(stepGraph_, options_.log2Batch, step_, batchInputs_, batchTargets_);
    trainer_.train(stepGraph_,
                   {{counters_, LearnedRows, 1u << options_.log2Batch}, batchInputs_, batchTargets_});
    stepGraph_.execute();
    profiler_.endFrame(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
}

void ImageLearner::warmUp() {
    learn(0); // a step without records changes nothing
    profiler_.reset();
    list(0, inferRows_);
    infer(listedInputs_, std::min(pixels_, inferRows_));
}

void ImageLearner::step() {
    learn(1u << options_.log2Batch);
    ++step_;
}

double ImageLearner::measure() {
    DisplayError error;
    const bool whole = measuredColours_.empty();
    if (whole) list(0, inferRows_);
    const auto colours = infer(whole ? listedInputs_ : measuredInputs_, std::min(pixels_, inferRows_));
    for (size_t i = 0; i < colours.size(); ++i)
        error.add(colours[i], whole ? picture_.colour(i) : measuredColours_[i]);
    return error.psnr();
}

std::vector<glm::vec3> ImageLearner::predict() {
    std::vector<glm::vec3> picture;
    picture.reserve(pixels_);
    for (uint32_t first = 0; first < pixels_; first += inferRows_) {
        list(first, inferRows_);
        for (const glm::vec4& colour : infer(listedInputs_, std::min(pixels_ - first, inferRows_)))
            picture.emplace_back(colour);
    }
    return picture;
}

} // namespace irradia
