#version 460
#extension GL_GOOGLE_include_directive : require
// One step of Adam (Kingma and Ba 2015, algorithm 1) and of the average that rendering uses,
//   Wbar_t = ((1 - alpha) W_t + alpha eta_(t-1) Wbar_(t-1)) / eta_t,  eta_t = 1 - alpha^t,
// which is unbiased from the first step on (Müller 2021 prints the second term without its eta_t).
// Parameters that are damaged, by whatever wrote them, become zero: one NaN would otherwise stay in the moments for good.
#include "lib/kernel.glsl"
#include "nrc/state.glsl"

STATE(0);
RECORDS_READ(1, gradients);
layout(set = 0, binding = 2, std430) buffer Values { vec4 values[]; };
layout(set = 0, binding = 3, std430) buffer FirstMoments { vec4 firstMoments[]; };
layout(set = 0, binding = 4, std430) buffer SecondMoments { vec4 secondMoments[]; };
layout(set = 0, binding = 5, std430) buffer Averages { vec4 averages[]; };
layout(push_constant) uniform Push { OptimizeParams params; };

bvec4 within(vec4 v, float limit) { return lessThanEqual(abs(v), vec4(limit)); }
bvec4 both(bvec4 a, bvec4 b) { return bvec4(uvec4(a) & uvec4(b)); }
uint count(bvec4 b) { uvec4 n = uvec4(b); return n.x + n.y + n.z + n.w; }

struct Parameters {
    vec4 value, first, second, average;
};

void heal(inout Parameters p) {
    bvec4 sound = both(both(within(p.value, kParameterLimit), within(p.average, kParameterLimit)),
                       both(within(p.first, kMomentLimit), within(p.second, kMomentLimit)));
    if (all(sound)) return;
    p.value = mix(vec4(0.0), p.value, sound);
    p.first = mix(vec4(0.0), p.first, sound);
    p.second = mix(vec4(0.0), p.second, sound);
    p.average = mix(vec4(0.0), p.average, sound);
    atomicAdd(state.damagedParameters, 4u - count(sound));
}

// Written out: mix(now, before, decay) may be taken as now - decay now + decay before, which leaves 24 bits of `now` but
// not of (1 - decay) now.
vec4 decayed(vec4 before, vec4 now, float decay) { return (1.0 - decay) * now + decay * before; }

void update(inout Parameters p, vec4 gradient) {
    bvec4 use = within(gradient, kGradientLimit);
    if (params.sparse != 0u) use = both(use, notEqual(gradient, vec4(0.0)));
    vec4 g = state.clipScale * gradient + params.l2 * p.value;
    vec4 first = decayed(p.first, g, params.beta1);
    vec4 second = decayed(p.second, g * g, params.beta2);
    vec4 change = first / state.eta1 / (sqrt(second / state.eta2) + params.epsilon);
    p.value = mix(p.value, p.value - params.learningRate * state.learningRateFactor * change, use);
    p.first = mix(p.first, first, use);
    p.second = mix(p.second, second, use);
    p.average = decayed(state.etaEmaBefore * p.average, p.value, params.emaDecay) / state.etaEma;
}

void main() {
    uint quad = gl_GlobalInvocationID.x;
    if (quad >= params.quads || state.batchRows == 0u) return;
    Parameters p = Parameters(values[quad], firstMoments[quad], secondMoments[quad], averages[quad]);
    heal(p);
    if (state.applied != 0u) {
        update(p, uintBitsToFloat(loadRecord(gradients, quad)));
        heal(p);
    }
    values[quad] = p.value;
    firstMoments[quad] = p.first;
    secondMoments[quad] = p.second;
    averages[quad] = p.average;
}
