#include "bench_mlp_traffic.h"

namespace irradia {
namespace {

// Bytes of a row's arrays, and of the weights by row of a batch.
struct Sizes {
    double inputs, hidden, results, weights;
};

Sizes sizesOf(const MlpCase& what, uint32_t rows) {
    const MlpShape& shape = what.shape;
    const double element = what.precision == Precision::Half ? 2 : 4;
    return {element * shape.inputs, element * shape.hiddenLayers * shape.width,
            16.0 * ((shape.outputs + 3) / 4), element * double(shape.multiplyAdds()) / rows};
}

RowTraffic evaluation(const Sizes& of) {
    const double fused = of.inputs + of.results + of.weights;
    return {fused, fused + 2 * of.hidden};
}

RowTraffic training(const Sizes& of, const Sizes& single) {
    const double forward = of.inputs + of.hidden + of.results + of.weights;
    const double loss = 3 * of.results;
    const double backward = 2 * of.results + 2 * of.hidden + of.weights; // activations in, gradients out
    const double weightGradient = of.inputs + 2 * of.hidden + of.results + single.weights;
    const double adam = 7 * single.weights; // weight and two moments in and out, the gradient in
    const double fused = forward + loss + backward + weightGradient + adam;
    // A kernel a layer reads the activations, and their gradients, that the one before it wrote.
    return {fused, fused + 2 * of.hidden};
}

} // namespace

RowTraffic trafficOf(const MlpCase& what, uint32_t rows) {
    const Sizes sizes = sizesOf(what, rows);
    if (!what.isTraining) return evaluation(sizes);
    MlpCase single = what;
    single.precision = Precision::Float;
    return training(sizes, sizesOf(single, rows));
}

} // namespace irradia
