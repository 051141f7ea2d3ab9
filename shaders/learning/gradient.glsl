// Gradients of parameters: quads of floats or, where FROM_SUMS is defined, the sums of accumulate_grid_gradient, first the
// low words of all parameters, then the high ones. Included after STATE.
#include "shared/network.h"

vec4 gradientFromSums(ivec4 low, ivec4 high) {
    return (vec4(high) * 4294967296.0 + vec4(low)) * (state.gradientScale / kGradientUnits);
}
