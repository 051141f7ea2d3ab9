#include "nrc/renderer/adaptation.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

constexpr uint32_t kFirstFrames = 8; // before which agreement says little: a mean of all places
constexpr float kDark = 0.01f;   // in the cache's scale
constexpr float kMost = 1.5f;    // of `full`: what a single frame, maybe of an outlier, can say
constexpr double kSlowest = 0.2; // learning rate: regions that come into view are to be learned

} // namespace

Adaptation::Adaptation(const AdaptationConfig& config, uint32_t steps, double emaDecay)
    : config_(config)
    , steps_(steps)
    , emaDecay_(emaDecay) {}

void Adaptation::observe(float meanPrediction, float meanTarget) {
    const uint32_t steps = effort().steps == 0 ? steps_ : effort().steps;
    taken_ += steps;
    const float ratio = (std::max(meanPrediction, 0.0f) + kDark) / (std::max(meanTarget, 0.0f) + kDark);
    const float most = kMost * config_.full;
    // Not a number where a prediction was none: the trainer dropped those records, nothing is urgent.
    const float now = std::isnan(ratio) ? 0.0f : std::clamp(std::log(ratio), -most, most);
    disagreement_ = config_.smoothing * disagreement_ + (1.0f - config_.smoothing) * now;
    observed_ = config_.smoothing * observed_ + (1.0f - config_.smoothing);
    const float beyond = std::abs(disagreement_ / observed_) - config_.threshold;
    hasLearned_ = hasLearned_ || (++frames_ >= kFirstFrames && beyond <= 0.0f);
    const float range = std::max(config_.full - config_.threshold, 1e-6f);
    urgency_ = std::max(std::clamp(beyond / range, 0.0f, 1.0f), config_.calming * urgency_);
    if (urgency_ < 0.01f) urgency_ = 0.0f; // exactly as configured, at last
    agreed_ = (1.0 - urgency_) * (agreed_ + steps);
}

TrainingEffort Adaptation::effort() const {
    TrainingEffort effort;
    if (!config_.on) return effort;
    if (config_.settling > 0)
        effort.learningRate = std::clamp(config_.settling / std::max(agreed_, 1.0), kSlowest, 1.0);
    if (urgency_ == 0.0f) return effort;
    const double most = std::max(config_.mostSteps, steps_);
    effort.steps = static_cast<uint32_t>(std::lround(steps_ + urgency_ * (most - steps_)));
    // What the average remembers, 1 / (1 - decay) steps, shrinks geometrically.
    const double shortest = std::min<double>(config_.shortestEma, emaDecay_);
    effort.emaDecay = 1.0 - (1.0 - emaDecay_) * std::pow((1.0 - shortest) / (1.0 - emaDecay_), urgency_);
    return effort;
}

float Adaptation::unbiasedShare(float configured) const {
    if (!config_.on || configured == 0.0f) return configured;
    const auto youth = static_cast<double>(config_.youth);
    const double young = youth / std::max(youth + static_cast<double>(taken_), 1.0);
    return std::max({configured, static_cast<float>(young), urgency_});
}

} // namespace irradia
