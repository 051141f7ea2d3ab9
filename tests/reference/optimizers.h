// Adam (Kingma and Ba 2015, algorithm 1) with l2 regularisation, a decaying learning rate and a limit of the
// gradient's norm (Pascanu et al. 2013), and the debiased exponential moving average of its weights, in
// double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradia::reference {

struct OptimizerSettings {
    double learningRate = 1e-2, featureLearningRate = 1e-2;
    double beta1 = 0.9, beta2 = 0.99, epsilon = 1e-8; // epsilon is added to sqrt(v)
    double l2 = 0.0;                                  // times the weight is added to its gradient
    double emaDecay = 0.0;
    uint32_t decayStart = 0, decayInterval = 0, decayEnd = UINT32_MAX; // in steps; 0 = no decay
    double decayBase = 1.0;
    double clipNorm = 0.0; // 0 = no limit
};

// decayBase^n at step t = 0, 1, ..: n multiples k >= 0 with decayStart + k decayInterval <= min(t, decayEnd).
inline double learningRateFactor(const OptimizerSettings& s, uint32_t t) {
    const uint32_t last = std::min(t, s.decayEnd);
    if (s.decayInterval == 0 || last < s.decayStart) return 1.0;
    return std::pow(s.decayBase, (last - s.decayStart) / s.decayInterval + 1);
}

// Scales the gradient to the norm `limit` where it is longer; whether it was.
inline bool clipNorm(std::vector<double>& gradient, double limit) {
    double squares = 0.0;
    for (const double g : gradient) squares += g * g;
    const double norm = std::sqrt(squares);
    if (limit <= 0.0 || norm <= limit) return false;
    for (double& g : gradient) g *= limit / norm;
    return true;
}

// Average W-bar_t of W_1 .. W_t: ((1 - a) W_t + a eta_(t-1) W-bar_(t-1)) / eta_t with eta_t = 1 - a^t.
struct MovingAverage {
    double decay = 0.0; // a in [0, 1)
    uint32_t t = 0;
    std::vector<double> values;

    void add(const std::vector<double>& weights) {
        values.resize(weights.size(), 0.0);
        const double before = 1.0 - std::pow(decay, t), after = 1.0 - std::pow(decay, ++t);
        for (std::size_t i = 0; i < weights.size(); ++i)
            values[i] = ((1.0 - decay) * weights[i] + decay * before * values[i]) / after;
    }
};

// The same as a sum: (1 - a) / (1 - a^t) sum_i a^(t - i) W_i.
inline double movingAverage(double decay, const std::vector<double>& history) {
    double sum = 0.0;
    for (const double w : history) sum = decay * sum + w;
    return sum * (1.0 - decay) / (1.0 - std::pow(decay, history.size()));
}

// All parameters, the network's weights first and then the features of a grid. A feature whose gradient is
// exactly 0 keeps its value and its moments.
struct Optimizer {
    OptimizerSettings settings;
    std::size_t networkWeights = 0;
    std::vector<double> parameters;
    std::vector<double> first{}, second{}; // moments
    MovingAverage average{settings.emaDecay};
    uint32_t steps = 0, clippedSteps = 0;

    void step(std::vector<double> gradient) {
        first.resize(parameters.size(), 0.0);
        second.resize(parameters.size(), 0.0);
        if (clipNorm(gradient, settings.clipNorm)) ++clippedSteps;
        const double factor = learningRateFactor(settings, steps++);
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            const bool isFeature = i >= networkWeights;
            if (isFeature && gradient[i] == 0.0) continue;
            const double g = gradient[i] + (isFeature ? 0.0 : settings.l2 * parameters[i]);
            move(i, g, factor * (isFeature ? settings.featureLearningRate : settings.learningRate));
        }
        average.add(parameters);
    }

private:
    void move(std::size_t i, double g, double rate) {
        first[i] = settings.beta1 * first[i] + (1.0 - settings.beta1) * g;
        second[i] = settings.beta2 * second[i] + (1.0 - settings.beta2) * g * g;
        const double m = first[i] / (1.0 - std::pow(settings.beta1, steps));
        const double v = second[i] / (1.0 - std::pow(settings.beta2, steps));
        parameters[i] -= rate * m / (std::sqrt(v) + settings.epsilon);
    }
};

} // namespace irradia::reference
