// Quads of rows (shared/network.h) in the network's precision: single, or half under VALUES_IN_HALF.
// VALUES_READ(binding, name): loadValues(name, index) -> vec4; VALUES_WRITE: storeValues(name, index, vec4), always through a
// storage buffer: lavapipe writes texel views in a loop over lanes and components, 2-3 times as slowly.
#ifdef VALUES_IN_HALF
#define VALUES_READ(slot, name) HALVES_READ(slot, name)
#define VALUES_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Values { uvec2 name[]; }
#define loadValues(name, index) loadHalves(name, index)
uvec2 valueBits(vec4 v) { return uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw)); }
#else
#define VALUES_READ(slot, name) QUADS_READ(slot, name)
#define VALUES_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Values { uvec4 name[]; }
#define loadValues(name, index) uintBitsToFloat(loadQuad(name, index))
uvec4 valueBits(vec4 v) { return floatBitsToUint(v); }
#endif
// The same where a pass is given an address (lib/store_by_address.glsl).
#ifdef VALUES_IN_HALF
#define storeValuesAt(address, index, value) storeHalvesAt(address, index, valueBits(value))
#else
#define storeValuesAt(address, index, value) storeQuadAt(address, index, valueBits(value))
#endif
#define storeValues(name, index, value) name[index] = valueBits(value)

// How many of the rows that a pass may have there are, from its `params` and `counters`.
#define ROW_COUNT (max(counters[params.counter], params.first) - params.first)
