#include "nrc/learning/encoding.h"

#include "engine/error.h"
#include "nrc/learning/encodings/slice.h"
#include "nrc/learning/random.h"

namespace irradia {
namespace {

constexpr float kInitialFeature = 1e-4f;

} // namespace

struct Encoding::State {
    EncodingLayout layout;
    uint64_t features = 0;
    std::optional<uint32_t> storedCorners;
    std::vector<std::unique_ptr<SlicePasses>> slices;
};

Encoding::Encoding(Device& device, const std::vector<EncodingConfig>& parts, uint32_t inputs,
                   Precision precision, std::span<const glm::vec3> touched)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.layout = layOut(parts, inputs);
    const FeatureLayout features = layOutFeatures(s.layout, device.limits(), touched);
    s.features = features.count;
    s.storedCorners = features.checksum;
    for (size_t i = 0; i < s.layout.slices.size(); ++i) {
        const SliceContext context{device, s.layout, s.layout.slices[i], precision, s.features};
        s.slices.push_back(features.slices[i] ? features.slices[i]->makePasses(context)
                                              : makePlainPasses(context));
    }
}

Encoding::~Encoding() = default;
Encoding::Encoding(Encoding&&) noexcept = default;

uint32_t Encoding::inputs() const {
    return state_->layout.inputs;
}
uint32_t Encoding::inputQuads() const {
    return state_->layout.inputQuads();
}
uint32_t Encoding::width() const {
    return state_->layout.encodedQuads * 4;
}
uint64_t Encoding::featureCount() const {
    return state_->features;
}
std::optional<uint32_t> Encoding::storedCorners() const {
    return state_->storedCorners;
}
uint64_t Encoding::sumBytes() const {
    return state_->features * 8;
}

void Encoding::initialise(std::span<float> features, uint64_t seed) const {
    if (features.size() != featureCount())
        fail(ExitCode::Internal, "encoding: {} features to initialise, not {}", features.size(),
             featureCount());
    RandomStream random(seed);
    for (float& feature : features) feature = kInitialFeature * (2.0f * random.uniform() - 1.0f);
}

void Encoding::encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange features,
                      BufferRange encoded) const {
    for (const auto& slice : state_->slices) slice->encode(graph, rows, inputs, features, encoded);
}

void Encoding::accumulateGradient(FrameGraph& graph, const RowCount& rows, BufferRange inputs,
                                  BufferRange encodedGradient, BufferRange sums) const {
    for (const auto& slice : state_->slices)
        slice->accumulateGradient(graph, rows, inputs, encodedGradient, sums);
}

} // namespace irradia
