// From what the network says to radiance, and back. Bindings: `cacheState`, and `counters` of the cache, writable.
#include "lib/math.glsl"

// Reflectance alpha + beta of a row of inputs (shared/cache_inputs.h).
#define REFLECTANCE(rows, row)                                                                                   \
    cacheReflectance(uintBitsToFloat(loadQuad(rows, quadIndex(row, 2u, kCacheInputQuads))),                    \
                     uintBitsToFloat(loadQuad(rows, quadIndex(row, 3u, kCacheInputQuads))))

// Below it a reflectance divides nothing: what such a channel scatters is not learned.
const float kMinReflectance = 1e-3;

// Radiance is never negative; a prediction that is no number is none.
vec3 toRadiance(vec3 prediction, vec3 factor) {
    vec3 l = prediction * factor / cacheState.scale;
    bool finite = all(lessThan(abs(l), vec3(1e15))); // before max, which makes 0 of NaN
    if (!finite) atomicAdd(counters[kClampedPredictions], 1u);
    return finite ? max(l, vec3(0.0)) : vec3(0.0);
}

vec3 toTarget(vec3 l, vec3 factor) {
    vec3 t = l / max(factor, vec3(kMinReflectance));
    return mix(vec3(0.0), t, greaterThanEqual(factor, vec3(kMinReflectance))) * cacheState.scale;
}
