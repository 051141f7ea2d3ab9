#version 460
#extension GL_GOOGLE_include_directive : require
#define QUADS_IN_HALF
#include "nrc/encode_spherical_harmonics.glsl"
