#version 460
#extension GL_GOOGLE_include_directive : require
// Whether this batch changes the parameters, and with which bias corrections, learning rate and clip.
#include "lib/kernel.glsl"
#include "learning/state.glsl"

STATE(0);
WORDS_READ(1, partials); // of the squared norm
layout(push_constant) uniform Push { BeginUpdateParams params; };

bool decays(uint steps) {
    return params.decayInterval > 0u && steps >= params.decayStart && steps <= params.decayEnd &&
           (steps - params.decayStart) % params.decayInterval == 0u;
}

void clipGradient() {
    float squared = 0.0;
    for (uint i = 0u; i < params.partials; ++i) squared += uintBitsToFloat(loadWord(partials, i));
    float norm = sqrt(squared);
    bool clips = params.partials > 0u && norm > params.clipNorm;
    state.clipScale = clips ? params.clipNorm / norm : 1.0;
    state.clippedSteps += clips ? 1u : 0u;
}

// 1 - decay^t from that of t - 1, without cancellation.
float nextEta(float eta, float decay) { return (1.0 - decay) + decay * eta; }

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    state.applied = state.validRecords > 0u ? 1u : 0u;
    if (state.applied == 0u) return;
    clipGradient();
    if (decays(state.steps)) state.learningRateFactor *= params.decayBase;
    state.eta1 = nextEta(state.eta1, params.beta1);
    state.eta2 = nextEta(state.eta2, params.beta2);
    state.etaEmaBefore = state.etaEma;
    state.etaEma = nextEta(state.etaEma, params.emaDecay);
    state.steps += 1u;
}
