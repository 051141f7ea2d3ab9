// What the scene and the view need of the kernels (shared/path.h): code for the rest is not compiled.
#ifndef IRRADIA_PATH_NEEDS_GLSL
#define IRRADIA_PATH_NEEDS_GLSL
#include "shared/path.h"

layout(constant_id = 10) const bool kHasEnvironment = true;
layout(constant_id = 11) const bool kHasEmitters = true;
layout(constant_id = 12) const uint kTextureMask = 63u;
layout(constant_id = 13) const bool kHasSpecular = true;
layout(constant_id = 14) const uint kView = kViewPicture;
layout(constant_id = 15) const bool kHasLightTree = false;
layout(constant_id = 16) const uint kSampler = kSamplerRandom;

#endif
