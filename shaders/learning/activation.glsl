// Activations: ReLU in hidden layers, a choice at the output.

vec4 relu(vec4 z) { return max(z, vec4(0.0)); }

// Where a layer's gradient passes its ReLU.
vec4 reluDerivative(vec4 activation) { return vec4(greaterThan(activation, vec4(0.0))); }

const float kLargestExponent = 30.0; // beyond it an exponential output stays as it is

vec4 activateOutput(vec4 z) {
    switch (kOutputActivation) {
    case kOutputReLU: return relu(z);
    case kOutputExponential: return exp(min(z, vec4(kLargestExponent)));
    case kOutputSoftplus: return relu(z) + log(1.0 + exp(-abs(z)));
    default: return z;
    }
}

// d result / d z from the result.
vec4 outputDerivative(vec4 result) {
    switch (kOutputActivation) {
    case kOutputReLU: return reluDerivative(result);
    case kOutputExponential: return result;
    case kOutputSoftplus: return 1.0 - exp(-result);
    default: return vec4(1.0);
    }
}
