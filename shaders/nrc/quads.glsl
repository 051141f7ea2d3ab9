// Quads of rows (shared/network.h) in the network's precision: single, or half under QUADS_IN_HALF.
// QUADS_READ(binding, name): loadQuad(name, index) -> vec4; QUADS_WRITE: storeQuad(name, index, vec4).
#ifdef QUADS_IN_HALF
#define QUADS_READ(slot, name) HALVES_READ(slot, name)
#define QUADS_WRITE(slot, name) HALVES_WRITE(slot, name)
#define loadQuad(name, index) loadHalves(name, index)
#define storeQuad(name, index, value) storeHalves(name, index, value)
#else
#define QUADS_READ(slot, name) RECORDS_READ(slot, name)
#define QUADS_WRITE(slot, name) RECORDS_WRITE(slot, name)
#define loadQuad(name, index) uintBitsToFloat(loadRecord(name, index))
#define storeQuad(name, index, value) storeRecord(name, index, floatBitsToUint(value))
#endif
