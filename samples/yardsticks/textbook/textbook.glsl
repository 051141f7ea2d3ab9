// Head of the textbook kernels: the network's shape as constants, and where a layer's values stand.
#include "lib/kernel.glsl"
#include "textbook.h"

layout(constant_id = 2) const uint kInputs = 64;
layout(constant_id = 3) const uint kWidth = 64;
layout(constant_id = 4) const uint kHiddenLayers = 5;
layout(constant_id = 5) const uint kOutputs = 3;
const uint kWidest = kInputs > kWidth ? kInputs : kWidth; // kOutputs is at most kWidth
layout(push_constant) uniform Push { TextbookParams params; };

#define FLOATS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Block { float name[]; }
#define FLOATS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Block { float name[]; }
#define FLOATS(slot, name) layout(set = 0, binding = slot, std430) buffer name##Block { float name[]; }

uint layerInputs(uint layer) { return layer == 0u ? kInputs : kWidth; }
uint layerOutputs(uint layer) { return layer == kHiddenLayers ? kOutputs : kWidth; }
uint firstWeight(uint layer) { return layer == 0u ? 0u : kWidth * (kInputs + (layer - 1u) * kWidth); }
// Of a hidden layer, in rows of kHiddenLayers * kWidth.
uint hiddenIndex(uint row, uint layer, uint neuron) { return (row * kHiddenLayers + layer) * kWidth + neuron; }
