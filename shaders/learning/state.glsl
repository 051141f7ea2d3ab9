// The training's state as kernels see it. STATE(binding) or STATE_READ(binding), then state.member.
#include "shared/training.h"

#define STATE(slot) layout(set = 0, binding = slot, std430) buffer StateBlock { TrainingState state; }
#define STATE_READ(slot) layout(set = 0, binding = slot, std430) readonly buffer StateBlock { TrainingState state; }

// Which values of a row's quad there are, of `count` a row: the others are padding, whatever they hold.
bvec4 existing(uint quad, uint count) { return lessThan(4u * quad + uvec4(0u, 1u, 2u, 3u), uvec4(count)); }

bool isWithin(vec4 v, float limit) { return all(lessThanEqual(abs(v), vec4(limit))); } // false for NaN
