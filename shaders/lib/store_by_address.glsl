// Stores by address instead of through a binding: lavapipe writes to a bound buffer in a loop over lanes and components, to
// addresses in one scatter per 64 bits. Bounds are not checked: only for buffers indexed by row number, never by what a
// scene says. Needs the extensions GL_EXT_buffer_reference and GL_EXT_shader_explicit_arithmetic_types_int64.
layout(buffer_reference, std430, buffer_reference_align = 16) writeonly buffer QuadAtAddress { u64vec2 bits; };
layout(buffer_reference, std430, buffer_reference_align = 8) writeonly buffer HalvesAtAddress { uint64_t bits; };

// Record `index` of those at `address`.
void storeQuadAt(uvec2 address, uint index, uvec4 quad) {
    QuadAtAddress(packUint2x32(address) + uint64_t(index * 16u)).bits =
        u64vec2(packUint2x32(quad.xy), packUint2x32(quad.zw));
}

// Four halves.
void storeHalvesAt(uvec2 address, uint index, uvec2 halves) {
    HalvesAtAddress(packUint2x32(address) + uint64_t(index * 8u)).bits = packUint2x32(halves);
}
