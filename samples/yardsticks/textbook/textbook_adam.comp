#version 460
#extension GL_GOOGLE_include_directive : require
// A step of Adam (Kingma and Ba 2015), one weight an invocation.
#include "textbook.glsl"

FLOATS_READ(0, gradients);
FLOATS(1, moments); // first and second, in turn
FLOATS(2, weights);

void main() {
    uint weight = gl_GlobalInvocationID.x;
    if (weight >= params.weights) return;
    float gradient = gradients[weight];
    float first = mix(gradient, moments[2u * weight], params.beta1);
    float second = mix(gradient * gradient, moments[2u * weight + 1u], params.beta2);
    moments[2u * weight] = first;
    moments[2u * weight + 1u] = second;
    float unbiasedFirst = first / (1.0 - pow(params.beta1, float(params.step)));
    float unbiasedSecond = second / (1.0 - pow(params.beta2, float(params.step)));
    weights[weight] -= params.learningRate * unbiasedFirst / (sqrt(unbiasedSecond) + params.epsilon);
}
