// How much is learned per frame: more, and forgotten faster, while what the cache predicts and what paths
// find disagree (a lamp was switched, the scene was entered), and as configured when they agree.
// Self-training hands light on by a bounce each time it has learned the last one: while the cache is young,
// or all is urgent, more of the training paths bring in light themselves.
#pragma once

#include "nrc/learning/trainer.h"

namespace irradia {

// Disagreement: ln((P + 0.01) / (T + 0.01)) of the mean luminance of predictions and targets at a frame's
// records, both in the cache's scale, where targets are around 1 on average; averaged over the last frames
// (from the first on without bias, as the weights are), since noise goes to both sides and a change to one.
struct AdaptationConfig {
    bool on = true;
    float smoothing = 0.6f;   // weight of the frames before in that average
    float threshold = 0.3f;   // size of the average up to which it may be noise
    float full = 0.7f;        // and from which on the urgency is 1
    uint32_t mostSteps = 16;  // of optimisation a frame, at urgency 1
    float shortestEma = 0.9f; // decay of the weights' average per step, at urgency 1
    float calming = 0.85f;    // share of the urgency that is left after a frame of agreement
    // Steps after which half of the suffixes of a young cache train themselves; 0 = as many as ever at once.
    uint32_t youth = 512;
    // Steps of agreement from which on the learning rate falls as one over their number, to a fifth (Robbins
    // and Monro 1951): what wanders by learning's own noise comes to rest. 0 = never.
    uint32_t settling = 1024;

    bool operator==(const AdaptationConfig&) const = default;
};

// Depends on what the frames before have found alone, so that the same frames learn the same.
class Adaptation {
public:
    // `steps` a frame and `emaDecay` when nothing is urgent.
    Adaptation(const AdaptationConfig& config, uint32_t steps, double emaDecay);

    void observe(float meanPrediction, float meanTarget); // of a frame that has learned
    TrainingEffort effort() const;                        // of the next
    // Of suffixes that end by roulette alone, in the next frame: at least `configured`; none if that is none.
    float unbiasedShare(float configured) const;
    float urgency() const { return urgency_; } // 0 to 1
    // Whether predictions and targets have agreed once: from then on the cache is worth showing.
    bool hasLearned() const { return hasLearned_; }

private:
    AdaptationConfig config_;
    uint32_t steps_;
    double emaDecay_;
    // Sums over frames: of their weights times disagreement, of their weights.
    float disagreement_ = 0.0f, observed_ = 0.0f;
    float urgency_ = 0.0f;
    uint32_t frames_ = 0; // observed
    bool hasLearned_ = false;
    uint64_t taken_ = 0;  // steps
    double agreed_ = 0.0; // of these since something was urgent
};

} // namespace irradia
