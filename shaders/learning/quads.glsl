// Quads of rows (shared/network.h) in the network's precision: single, or half under QUADS_IN_HALF.
// QUADS_READ(binding, name): loadQuad(name, index) -> vec4; QUADS_WRITE: storeQuad(name, index, vec4), always through a
// storage buffer: lavapipe writes texel views in a loop over lanes and components, 2-3 times as slowly.
#ifdef QUADS_IN_HALF
#define QUADS_READ(slot, name) HALVES_READ(slot, name)
#define QUADS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Quads { uvec2 name[]; }
#define loadQuad(name, index) loadHalves(name, index)
uvec2 quadBits(vec4 v) { return uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw)); }
#else
#define QUADS_READ(slot, name) RECORDS_READ(slot, name)
#define QUADS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Quads { uvec4 name[]; }
#define loadQuad(name, index) uintBitsToFloat(loadRecord(name, index))
uvec4 quadBits(vec4 v) { return floatBitsToUint(v); }
#endif
// The same where a pass is given an address (lib/store_by_address.glsl).
#ifdef QUADS_IN_HALF
#define storeQuadAt(address, index, value) storeHalvesAt(address, index, quadBits(value))
#else
#define storeQuadAt(address, index, value) storeRecordAt(address, index, quadBits(value))
#endif
#define storeQuad(name, index, value) name[index] = quadBits(value)

// How many of the rows that a pass may have there are, from its `params` and `counters`.
#define ROW_COUNT (max(counters[params.counter], params.first) - params.first)
