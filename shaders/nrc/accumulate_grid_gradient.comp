#version 460
#extension GL_GOOGLE_include_directive : require
#include "nrc/accumulate_grid_gradient.glsl"
