#version 460
#extension GL_GOOGLE_include_directive : require
#include "nrc/encode_spherical_harmonics.glsl"
