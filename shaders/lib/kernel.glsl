// Head of every kernel: workgroup and subgroup size (constants 0 and 1, set by engine/gpu/kernel) and record access.
// Records are read and written through texel views (RECORDS_IN_TEXEL, the fast form on lavapipe: one bounds-checked
// 128-bit load per lane) or through storage buffers (RECORDS_IN_STORAGE, where texel views are too small).
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kSubgroupSize = 8;

// RECORDS_READ(binding, name): loadRecord(name, index) -> uvec4.
// RECORDS_WRITE(binding, name): storeRecord(name, index, uvec4). RECORDS: both.
// WORDS_WRITE(binding, name): storeWord(name, index, uint); WORDS_READ: loadWord(name, index) -> uint.
// HALVES_READ(binding, name): loadHalves(name, index) -> vec4 of four 16-bit floats.
#ifdef RECORDS_IN_TEXEL
#define RECORDS_READ(slot, name) layout(set = 0, binding = slot, rgba32ui) readonly uniform uimageBuffer name
#define RECORDS_WRITE(slot, name) layout(set = 0, binding = slot, rgba32ui) writeonly uniform uimageBuffer name
#define RECORDS(slot, name) layout(set = 0, binding = slot, rgba32ui) uniform uimageBuffer name
#define WORDS_READ(slot, name) layout(set = 0, binding = slot, r32ui) readonly uniform uimageBuffer name
#define WORDS_WRITE(slot, name) layout(set = 0, binding = slot, r32ui) writeonly uniform uimageBuffer name
#define HALVES_READ(slot, name) layout(set = 0, binding = slot, rgba16f) readonly uniform imageBuffer name
#define loadRecord(name, index) imageLoad(name, int(index))
#define storeRecord(name, index, value) imageStore(name, int(index), value)
#define loadWord(name, index) imageLoad(name, int(index)).x
#define storeWord(name, index, value) imageStore(name, int(index), uvec4(value))
#define loadHalves(name, index) imageLoad(name, int(index))
#else
#define RECORDS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Records { uvec4 name[]; }
#define RECORDS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Records { uvec4 name[]; }
#define RECORDS(slot, name) layout(set = 0, binding = slot, std430) buffer name##Records { uvec4 name[]; }
#define WORDS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Words { uint name[]; }
#define WORDS_WRITE(slot, name) layout(set = 0, binding = slot, std430) writeonly buffer name##Words { uint name[]; }
#define HALVES_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Halves { uvec2 name[]; }
#define loadRecord(name, index) name[index]
#define storeRecord(name, index, value) name[index] = value
#define loadWord(name, index) name[index]
#define storeWord(name, index, value) name[index] = value
#define loadHalves(name, index) unpackHalves(name[index])
vec4 unpackHalves(uvec2 v) { return vec4(unpackHalf2x16(v.x), unpackHalf2x16(v.y)); }
#endif

// COUNTERS_READ(binding, name) / COUNTERS(binding, name): a plain storage buffer of uints.
#define COUNTERS_READ(slot, name) layout(set = 0, binding = slot, std430) readonly buffer name##Block { uint name[]; }
#define COUNTERS(slot, name) layout(set = 0, binding = slot, std430) buffer name##Block { uint name[]; }
