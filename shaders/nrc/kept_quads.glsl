// Stores of what training passes keep, by address: lavapipe writes to a bound buffer in a loop over lanes and components,
// to addresses in one scatter per 64 bits. These buffers are indexed by row and layer alone, never by what a scene says.
#ifdef QUADS_IN_HALF
layout(buffer_reference, std430, buffer_reference_align = 8) writeonly buffer QuadAtAddress { uint64_t bits; };
const uint kQuadBytes = 8u;
uint64_t wideBits(uvec2 quad) { return packUint2x32(quad); }
#else
layout(buffer_reference, std430, buffer_reference_align = 16) writeonly buffer QuadAtAddress { u64vec2 bits; };
const uint kQuadBytes = 16u;
u64vec2 wideBits(uvec4 quad) { return u64vec2(packUint2x32(quad.xy), packUint2x32(quad.zw)); }
#endif

void storeKept(uint index, vec4 v) {
    QuadAtAddress(packUint2x32(params.kept) + uint64_t(index * kQuadBytes)).bits = wideBits(quadBits(v));
}
