#version 460
#extension GL_GOOGLE_include_directive : require
#define WITH_CACHE
#include "path/handle_emissive_hits.glsl"
