#version 460
#extension GL_GOOGLE_include_directive : require
#define QUADS_IN_HALF
#define KEEP_ACTIVATIONS
#include "nrc/forward_workgroup.glsl"
