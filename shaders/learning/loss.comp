#version 460
#extension GL_GOOGLE_include_directive : require
// Loss and brightness of every row of a part of the batch, and the gradient of the loss by the results, before the mean over
// the batch is taken: (p - t)^2 / d^e with the denominator d = p^2 + epsilon detached (Lehtinen 2018), or with p's luminance
// for all channels (Müller 2021, 4.3).
#include "lib/kernel.glsl"
#include "lib/math.glsl"
#include "learning/state.glsl"
#include "shared/constants.h"
#include "shared/network.h"

layout(constant_id = kConstantLoss) const uint kLoss = kLossL2;
layout(constant_id = kConstantLossOutputs) const uint kOutputs = 3u;
const uint kQuads = (kOutputs + 3u) / 4u;

STATE(0);
QUADS_READ(1, results);
QUADS_READ(2, targets);
WORDS_READ(3, usable);
QUADS_WRITE(4, resultGradient);
QUADS_WRITE(5, rowSums); // loss, luminance of the prediction and of the target, 1; all zero where the row is not used
layout(push_constant) uniform Push { LossParams params; };

// From exponentStart to exponentEnd over the steps [annealStart, annealEnd].
float exponent() {
    float length = max(float(params.annealEnd) - float(params.annealStart), 1.0);
    float done = params.annealEnd > params.annealStart
                     ? clamp((float(state.steps) - float(params.annealStart)) / length, 0.0, 1.0)
                     : (state.steps >= params.annealEnd ? 1.0 : 0.0);
    return mix(params.exponentStart, params.exponentEnd, done);
}

vec4 denominator(vec4 prediction) {
    if (kLoss == kLossL2) return vec4(1.0);
    vec4 squared = kLoss == kLossRelativeL2 ? prediction * prediction : vec4(square(luminance(prediction.xyz)));
    float e = exponent();
    vec4 d = squared + params.epsilon;
    return e == 1.0 ? d : exp2(e * log2(d));
}

vec4 handedOn(vec4 gradient) { return clamp(params.lossScale * gradient, -params.gradientLimit, params.gradientLimit); }

// A quad's part of the row's brightness.
float brightness(vec4 values) { return kOutputs == 3u ? luminance(values.xyz) : dot(values, vec4(1.0 / float(kOutputs))); }

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (params.first + row >= state.batchRows) return;
    vec4 gradient[kQuads];
    float loss = 0.0, predicted = 0.0, wanted = 0.0;
    bool finite = true;
    [[unroll]] for (uint q = 0u; q < kQuads; ++q) {
        bvec4 exists = existing(q, kOutputs);
        vec4 prediction = mix(vec4(0.0), uintBitsToFloat(loadQuad(results, quadIndex(row, q, kQuads))), exists);
        vec4 target = mix(vec4(0.0), uintBitsToFloat(loadQuad(targets, quadIndex(row, q, kQuads))), exists);
        vec4 difference = prediction - target;
        vec4 d = denominator(prediction);
        gradient[q] = 2.0 * difference / d;
        loss += dot(difference, difference / d);
        predicted += brightness(prediction);
        wanted += brightness(target);
        finite = finite && isWithin(prediction, kPredictionLimit) && isWithin(gradient[q], kGradientLimit);
    }
    bool usableRow = loadWord(usable, row) != 0u;
    bool use = usableRow && finite && loss <= kGradientLimit;
    [[unroll]] for (uint q = 0u; q < kQuads; ++q)
        storeQuad(resultGradient, quadIndex(row, q, kQuads), floatBitsToUint(use ? handedOn(gradient[q]) : vec4(0.0)));
    storeQuad(rowSums, row, floatBitsToUint(use ? vec4(loss, predicted, wanted, 1.0) : vec4(0.0)));
    if (usableRow && !use) atomicAdd(state.droppedRecords, 1u);
}
