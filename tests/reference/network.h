// A multilayer perceptron in double precision: hidden layers of one width with ReLU, no bias vectors (Müller
// et al. 2021, section 4), and its derivatives by backpropagation (Rumelhart et al. 1986).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace irradia::reference {

// Of the outputs.
enum class Activation { None, ReLU, Exponential, Softplus }; // z, max(z, 0), exp(min(z, 30)), log(1 + exp(z))

double activate(Activation activation, double z);
double activationSlope(Activation activation, double z);

// A layer's weights among all of them: row-major, a row per output.
struct Matrix {
    std::size_t offset, rows, columns;
};

struct Mlp {
    std::size_t inputs = 16, width = 16, hiddenLayers = 1, outputs = 1;
    Activation output = Activation::None;
    std::size_t storedOutputs = 16; // rows of the last matrix; those beyond `outputs` have no meaning
    // How activations and gradients are kept for later passes, e.g. roundToHalf; null: as they are.
    std::function<double(double)> store;
    bool handsOnStored = true; // to the next layer; else what has not been rounded

    std::vector<Matrix> matrices() const;
    std::size_t weightCount() const;

    // layers[0]: the inputs; layers[l]: outputs of hidden layer l.
    struct Activations {
        std::vector<std::vector<double>> layers;
        std::vector<double> z; // of the outputs
        std::vector<double> results;
        double margin = 0.0; // smallest |z| of a hidden neuron: how close ReLU's kink is
    };
    Activations forward(const std::vector<double>& weights, const std::vector<double>& input) const;

    // Adds the derivatives of a scalar by the weights, from those by the results; returns those by the
    // inputs. A hidden neuron's slope is 1 where its activation is positive.
    std::vector<double> backward(const std::vector<double>& weights, const Activations& activations,
                                 const std::vector<double>& resultGradient,
                                 std::vector<double>& weightGradient) const;

private:
    double kept(double x) const { return store ? store(x) : x; }
    std::vector<double> kept(std::vector<double> x) const;
};

} // namespace irradia::reference
