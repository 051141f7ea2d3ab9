// Losses as means over rows and outputs, in double precision: squared error, and relative squared error with
// the denominator held constant (Lehtinen et al. 2018; by the prediction's luminance: Müller et al. 2021,
// section 5).
#pragma once

#include "tests/reference/math.h"
#include <cstddef>
#include <vector>

namespace irradia::reference {

enum class Loss { L2, RelativeL2, RelativeL2Luminance };

struct LossSettings {
    Loss type = Loss::L2;
    double epsilon = 0.01;
    double exponent = 1.0; // of the denominator
};

// (1 - x) start + x end with x from 0 to 1 over the steps [from, to]; `end` from `to` on.
inline double annealedExponent(double start, double end, double from, double to, double step) {
    if (step >= to) return end;
    return start + (end - start) * std::max(step - from, 0.0) / (to - from);
}

// By which a row's squared errors are divided: (p^2 + epsilon)^exponent, p the prediction or its luminance.
inline std::vector<double> lossDenominators(const LossSettings& loss, const double* prediction,
                                            std::size_t outputs) {
    std::vector<double> all(outputs, 1.0);
    for (std::size_t o = 0; o < outputs; ++o) {
        double p = prediction[o];
        if (loss.type == Loss::RelativeL2Luminance)
            p = luminance({prediction[0], prediction[1], prediction[2]});
        if (loss.type != Loss::L2) all[o] = std::pow(p * p + loss.epsilon, loss.exponent);
    }
    return all;
}

struct LossValue {
    double mean = 0.0;
    std::vector<double> gradient; // by the predictions
};

// Rows of `outputs` values, one row after the other. `detached`: the predictions in the denominators.
inline LossValue evaluateLoss(const LossSettings& loss, const std::vector<double>& predictions,
                              const std::vector<double>& targets, std::size_t outputs,
                              const std::vector<double>& detached) {
    LossValue value;
    const auto count = static_cast<double>(predictions.size());
    for (std::size_t first = 0; first < predictions.size(); first += outputs) {
        const std::vector<double> denominators = lossDenominators(loss, &detached[first], outputs);
        for (std::size_t o = 0; o < outputs; ++o) {
            const double error = predictions[first + o] - targets[first + o];
            value.mean += error * error / denominators[o] / count;
            value.gradient.push_back(2.0 * error / denominators[o] / count);
        }
    }
    return value;
}

inline LossValue evaluateLoss(const LossSettings& loss, const std::vector<double>& predictions,
                              const std::vector<double>& targets, std::size_t outputs) {
    return evaluateLoss(loss, predictions, targets, outputs, predictions);
}

} // namespace irradia::reference
