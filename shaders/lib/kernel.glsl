// Head of every kernel: workgroup and subgroup size (constants 0 and 1, set by engine/gpu/kernel) and quad access.
// Records are read and written through texel views (QUADS_IN_TEXEL, the fast form on lavapipe: one bounds-checked
// 128-bit load per lane) or through storage buffers (QUADS_IN_STORAGE, where texel views are too small).
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kSubgroupSize = 8;

// QUADS_READ(binding, name): loadQuad(name, index) -> uvec4.
// QUADS_WRITE(binding, name): storeQuad(name, index, uvec4). QUADS: both.
// WORDS_WRITE(binding, name): storeWord(name, index, uint); WORDS_READ: loadWord(name, index) -> uint.
// HALVES_READ(binding, name): loadHalves(name, index) -> vec4 of four 16-bit floats.
#ifdef QUADS_IN_TEXEL
#define QUADS_READ(slot, name) layout(set = 0, binding = slot, rgba32ui) readonly uniform uimageBuffer name
#define QUADS_WRITE(slot, name) layout(set = 0, binding = slot, rgba32ui) writeonly uniform uimageBuffer name
#define QUADS(slot, name) layout(set = 0, binding = slot, rgba32ui) uniform uimageBuffer name
#define WORDS_READ(slot, name) layout(set = 0, binding = slot, r32ui) readonly uniform uimageBuffer name
#define WORDS_WRITE(slot, name) layout(set = 0, binding = slot, r32ui) writeonly uniform uimageBuffer name
#define HALVES_READ(slot, name) layout(set = 0, binding = slot, rgba16f) readonly uniform imageBuffer name
#define loadQuad(name, index) imageLoad(name, int(index))
#define storeQuad(name, index, value) imageStore(name, int(index), value)
#define loadWord(name, index) imageLoad(name, int(index)).x
#define storeWord(name, index, value) imageStore(name, int(index), uvec4(value))
#define loadHalves(name, index) imageLoad(name, int(index))
#else
#define QUADS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Quads { uvec4 name[]; }
#define QUADS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Quads { uvec4 name[]; }
#define QUADS(slot, name) layout(set = 0, binding = slot, std430) buffer name##Quads { uvec4 name[]; }
#define WORDS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Words { uint name[]; }
#define WORDS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Words { uint name[]; }
#define HALVES_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Halves { uvec2 name[]; }
#define loadQuad(name, index) name[index]
#define storeQuad(name, index, value) name[index] = value
#define loadWord(name, index) name[index]
#define storeWord(name, index, value) name[index] = value
#define loadHalves(name, index) unpackHalves(name[index])
vec4 unpackHalves(uvec2 v) { return vec4(unpackHalf2x16(v.x), unpackHalf2x16(v.y)); }
#endif

// COUNTERS_READ(binding, name) / COUNTERS(binding, name): a plain storage buffer of uints.
#define COUNTERS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Block { uint name[]; }
#define COUNTERS(slot, name) layout(set = 0, binding = slot, std430) buffer name##Block { uint name[]; }
