#include "tests/reference/network.h"

#include <algorithm>
#include <cmath>

namespace irradia::reference {

namespace {

constexpr double kLargestExponent = 30.0;

// y = M x, of the first `rows` rows.
std::vector<double> multiply(const std::vector<double>& weights, const Matrix& m,
                             const std::vector<double>& x, std::size_t rows) {
    std::vector<double> y(rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < m.columns; ++c) y[r] += weights[m.offset + r * m.columns + c] * x[c];
    return y;
}

// Through y = M x: adds the derivatives by M.
void addOuterProduct(const Matrix& m, const std::vector<double>& yGradient, const std::vector<double>& x,
                     std::vector<double>& weightGradient) {
    for (std::size_t r = 0; r < yGradient.size(); ++r)
        for (std::size_t c = 0; c < m.columns; ++c)
            weightGradient[m.offset + r * m.columns + c] += yGradient[r] * x[c];
}

// The same, by x.
std::vector<double> multiplyTransposed(const std::vector<double>& weights, const Matrix& m,
                                       const std::vector<double>& yGradient) {
    std::vector<double> xGradient(m.columns, 0.0);
    for (std::size_t r = 0; r < yGradient.size(); ++r)
        for (std::size_t c = 0; c < m.columns; ++c)
            xGradient[c] += yGradient[r] * weights[m.offset + r * m.columns + c];
    return xGradient;
}

} // namespace

double activate(Activation activation, double z) {
    switch (activation) {
    case Activation::ReLU:
        return std::max(z, 0.0);
    case Activation::Exponential:
        return std::exp(std::min(z, kLargestExponent));
    case Activation::Softplus:
        return std::max(z, 0.0) + std::log1p(std::exp(-std::abs(z)));
    case Activation::None:
        break;
    }
    return z;
}

double activationSlope(Activation activation, double z) {
    switch (activation) {
    case Activation::ReLU:
        return z > 0.0 ? 1.0 : 0.0;
    case Activation::Exponential:
        return z < kLargestExponent ? std::exp(z) : 0.0;
    case Activation::Softplus:
        return 1.0 / (1.0 + std::exp(-z));
    case Activation::None:
        break;
    }
    return 1.0;
}

std::vector<Matrix> Mlp::matrices() const {
    std::vector<Matrix> all{{0, width, inputs}};
    const auto push = [&](std::size_t rows) {
        const Matrix& last = all.back();
        all.push_back({last.offset + last.rows * last.columns, rows, width});
    };
    for (std::size_t l = 1; l < hiddenLayers; ++l) push(width);
    push(storedOutputs);
    return all;
}

std::size_t Mlp::weightCount() const {
    const Matrix last = matrices().back();
    return last.offset + last.rows * last.columns;
}

std::vector<double> Mlp::kept(std::vector<double> x) const {
    for (double& value : x) value = kept(value);
    return x;
}

Mlp::Activations Mlp::forward(const std::vector<double>& weights, const std::vector<double>& input) const {
    Activations made;
    made.margin = INFINITY;
    made.layers.push_back(input);
    const std::vector<Matrix> all = matrices();
    std::vector<double> a = input;
    for (std::size_t l = 0; l < hiddenLayers; ++l) {
        a = multiply(weights, all[l], a, width);
        for (double& z : a) {
            made.margin = std::min(made.margin, std::abs(z));
            z = std::max(z, 0.0);
        }
        made.layers.push_back(kept(a));
        if (handsOnStored) a = made.layers.back();
    }
    made.z = multiply(weights, all.back(), a, outputs);
    for (const double z : made.z) made.results.push_back(activate(output, z));
    return made;
}

std::vector<double> Mlp::backward(const std::vector<double>& weights, const Activations& activations,
                                  const std::vector<double>& resultGradient,
                                  std::vector<double>& weightGradient) const {
    const std::vector<Matrix> all = matrices();
    std::vector<double> gradient;
    for (std::size_t o = 0; o < outputs; ++o)
        gradient.push_back(resultGradient[o] * activationSlope(output, activations.z[o]));
    for (std::size_t l = hiddenLayers; l > 0; --l) {
        const std::vector<double>& a = activations.layers[l];
        addOuterProduct(all[l], kept(gradient), a, weightGradient);
        gradient = multiplyTransposed(weights, all[l], handsOnStored ? kept(gradient) : gradient);
        for (std::size_t n = 0; n < width; ++n)
            if (a[n] <= 0.0) gradient[n] = 0.0;
    }
    addOuterProduct(all[0], kept(gradient), activations.layers[0], weightGradient);
    return kept(multiplyTransposed(weights, all[0], handsOnStored ? kept(gradient) : gradient));
}

} // namespace irradia::reference
