// Shape of a network and of its packed weights, as specialisation constants set by nrc/learning/network_kernels.cpp.
//
// Packed weights are matrices stored like rows (shared/network.h): one row an output, its quads the inputs. First come
// W_0, the hidden matrices and the output matrix, padded to kFeaturePadding rows; then their transposes in that order.
#include "shared/constants.h"
#include "shared/network.h"

layout(constant_id = kConstantInputQuads) const uint kInputQuads = 16u;
layout(constant_id = kConstantWidthQuads) const uint kWidthQuads = 16u;
layout(constant_id = kConstantHiddenLayers) const uint kHiddenLayers = 5u;
layout(constant_id = kConstantOutputQuads) const uint kOutputQuads = 1u;
layout(constant_id = kConstantOutputActivation) const uint kOutputActivation = kOutputNone;

// Where matrices begin, in quads.
const uint kInputMatrix = 0u;
const uint kHiddenMatrices = kInputQuads * kWidthQuads * 4u;
const uint kHiddenMatrixQuads = kWidthQuads * kWidthQuads * 4u;
const uint kOutputMatrix = kHiddenMatrices + (kHiddenLayers - 1u) * kHiddenMatrixQuads;
const uint kTransposed = kOutputMatrix + kWidthQuads * kFeaturePadding; // of these three
const uint kOutputTransposed = kTransposed + kOutputMatrix;

const uint kLargestQuads = kInputQuads > kWidthQuads ? kInputQuads : kWidthQuads;

// Where activations of a hidden layer, and gradients by them, stand in their rows.
const uint kActivationQuads = kHiddenLayers * kWidthQuads;
const uint kGradientQuads = kActivationQuads + kOutputQuads;
