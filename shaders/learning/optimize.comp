#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : enable
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : enable
#pragma variant optimize_by_address BY_ADDRESS
#pragma variant optimize_from_sums FROM_SUMS
#pragma variant optimize_from_sums_by_address FROM_SUMS BY_ADDRESS
// One step of Adam (Kingma and Ba 2015, algorithm 1) and of the average that rendering uses,
//   Wbar_t = ((1 - alpha) W_t + alpha eta_(t-1) Wbar_(t-1)) / eta_t,  eta_t = 1 - alpha^t,
// which is unbiased from the first step on (Müller 2021 prints the second term without its eta_t).
// From sums of gradients a parameter whose sum is exactly 0 keeps its value and moments, and the sums become zero.
// Parameters that are damaged, by whatever wrote them, become zero: one NaN would otherwise stay in the moments for good.
#include "lib/kernel.glsl"
#include "learning/state.glsl"

// OWN(binding, name): quads of which an invocation reads and writes those of its quad alone.
#ifdef BY_ADDRESS
#include "lib/store_by_address.glsl"
#define OWN(slot, name) QUADS(slot, name)
#define loadOwn(name, index) loadQuad(name, index)
#define storeOwn(name, index, record) storeQuadAt(params.name, index, record)
#else
#define OWN(slot, name) layout(set = 0, binding = slot, std430) buffer name##Quads { uvec4 name[]; }
#define loadOwn(name, index) name[index]
#define storeOwn(name, index, quad) name[index] = quad
#endif

STATE(0);
#ifdef FROM_SUMS
OWN(1, gradients);
#else
QUADS_READ(1, gradients);
#endif
OWN(2, values);
OWN(3, firstMoments);
OWN(4, secondMoments);
OWN(5, averages);
layout(push_constant) uniform Push { OptimizeParams params; };

#include "learning/gradient.glsl"

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
#ifdef FROM_SUMS
    use = both(use, notEqual(gradient, vec4(0.0)));
#endif
    vec4 g = state.clipScale * gradient + params.l2 * p.value;
    vec4 first = decayed(p.first, g, params.beta1);
    vec4 second = decayed(p.second, g * g, params.beta2);
    vec4 change = first / state.eta1 / (sqrt(second / state.eta2) + params.epsilon);
    p.value = mix(p.value, p.value - params.learningRate * state.learningRateFactor * change, use);
    p.first = mix(p.first, first, use);
    p.second = mix(p.second, second, use);
    p.average = decayed(state.etaEmaBefore * p.average, p.value, params.emaDecay) / state.etaEma;
}

vec4 takeGradient(uint quad) {
#ifdef FROM_SUMS
    uint highQuad = params.quads + quad;
    ivec4 low = ivec4(loadOwn(gradients, quad)), high = ivec4(loadOwn(gradients, highQuad));
    storeOwn(gradients, quad, uvec4(0u));
    if (high != ivec4(0)) storeOwn(gradients, highQuad, uvec4(0u));
    return gradientFromSums(low, high);
#else
    return uintBitsToFloat(loadQuad(gradients, quad));
#endif
}

void main() {
    uint quad = gl_GlobalInvocationID.x;
    if (quad >= params.quads || state.batchRows == 0u) return;
    Parameters p = Parameters(uintBitsToFloat(loadOwn(values, quad)), uintBitsToFloat(loadOwn(firstMoments, quad)),
                              uintBitsToFloat(loadOwn(secondMoments, quad)), uintBitsToFloat(loadOwn(averages, quad)));
    vec4 gradient = takeGradient(quad);
    heal(p);
    if (state.applied != 0u) {
        update(p, gradient);
        heal(p);
    }
    storeOwn(values, quad, floatBitsToUint(p.value));
    storeOwn(firstMoments, quad, floatBitsToUint(p.first));
    storeOwn(secondMoments, quad, floatBitsToUint(p.second));
    storeOwn(averages, quad, floatBitsToUint(p.average));
}
