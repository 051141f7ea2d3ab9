// Training in double precision: a network on encoded inputs, a loss, an optimiser; one step takes all records
// it is given. With a grid, the first inputs of a row are a position in it.
#pragma once

#include "tests/reference/encodings.h"
#include "tests/reference/feature_grid.h"
#include "tests/reference/losses.h"
#include "tests/reference/network.h"
#include "tests/reference/optimizers.h"
#include <optional>

namespace irradia::reference {

struct Training {
    Mlp network;
    LossSettings loss; // its exponent follows from the next four
    double exponentStart = 1.0, exponentEnd = 1.0;
    double annealStart = 0.0, annealEnd = 0.0;
    Optimizer optimizer;
    std::optional<FeatureGrid> grid{};
    std::size_t gridInputs = 0;
    // Gradients pass through the network multiplied by it, so that formats of little range can keep them
    // (Micikevicius et al. 2018, section 3.2).
    double gradientScale = 1.0;

    std::vector<double> predict(const std::vector<double>& parameters, const Values& inputs) const {
        return forward(parameters, inputs).results;
    }

    // Rows side by side; the mean loss before the step.
    double step(const std::vector<Values>& inputs, const std::vector<double>& targets) {
        std::vector<Mlp::Activations> made;
        std::vector<double> predictions;
        for (const Values& row : inputs) {
            made.push_back(forward(optimizer.parameters, row));
            append(predictions, made.back().results);
        }
        loss.exponent = annealedExponent(exponentStart, exponentEnd, annealStart, annealEnd, optimizer.steps);
        const LossValue value = evaluateLoss(loss, predictions, targets, network.outputs);
        optimizer.step(gradient(inputs, made, value.gradient));
        return value.mean;
    }

private:
    static void append(std::vector<double>& to, const std::vector<double>& from) {
        to.insert(to.end(), from.begin(), from.end());
    }

    // The network's weights as it keeps them, or the features.
    std::vector<double> weightsIn(const std::vector<double>& parameters) const {
        std::vector<double> weights(parameters.begin(),
                                    parameters.begin() + static_cast<std::ptrdiff_t>(network.weightCount()));
        for (double& w : weights) w = network.store ? network.store(w) : w;
        return weights;
    }
    std::vector<double> featuresIn(const std::vector<double>& parameters) const {
        return {parameters.begin() + static_cast<std::ptrdiff_t>(network.weightCount()), parameters.end()};
    }

    Values position(const Values& inputs) const {
        return {inputs.begin(), inputs.begin() + static_cast<std::ptrdiff_t>(gridInputs)};
    }

    Mlp::Activations forward(const std::vector<double>& parameters, const Values& inputs) const {
        const Values rest(inputs.begin() + static_cast<std::ptrdiff_t>(gridInputs), inputs.end());
        Values encoded = grid ? composite({grid->encode(position(inputs), featuresIn(parameters)), rest})
                              : composite({rest});
        for (double& e : encoded) e = network.store ? network.store(e) : e;
        return network.forward(weightsIn(parameters), encoded);
    }

    // By all parameters, from that of the mean loss by all predictions.
    std::vector<double> gradient(const std::vector<Values>& inputs, const std::vector<Mlp::Activations>& made,
                                 const std::vector<double>& byPredictions) const {
        const std::vector<double> weights = weightsIn(optimizer.parameters);
        // Through the network go gradients of a record's own sum of losses, not of the mean.
        const double scale = gradientScale * static_cast<double>(byPredictions.size());
        std::vector<double> byWeights(weights.size(), 0.0),
            byFeatures(optimizer.parameters.size() - weights.size(), 0.0);
        for (std::size_t row = 0; row < inputs.size(); ++row) {
            std::vector<double> own;
            for (std::size_t o = 0; o < network.outputs; ++o)
                own.push_back(scale * byPredictions[row * network.outputs + o]);
            const std::vector<double> byInputs = network.backward(weights, made[row], own, byWeights);
            if (grid) grid->addGradient(position(inputs[row]), byInputs, byFeatures);
        }
        append(byWeights, byFeatures);
        for (double& g : byWeights) g /= scale;
        return byWeights;
    }
};

} // namespace irradia::reference
