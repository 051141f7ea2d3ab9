// What the scene and the view need of the kernels (shared/path.h): code for the rest is not compiled.
#ifndef IRRADIA_PATH_NEEDS_GLSL
#define IRRADIA_PATH_NEEDS_GLSL
#include "shared/path.h"
#include "shared/scene.h"

layout(constant_id = kConstantEnvironment) const bool kHasEnvironment = true;
layout(constant_id = kConstantEmitters) const bool kHasEmitters = true;
layout(constant_id = kConstantTextures) const uint kTextureMask = 63u;
layout(constant_id = kConstantSpecular) const bool kHasSpecular = true;
layout(constant_id = kConstantView) const uint kView = kViewPicture;
layout(constant_id = kConstantLightTree) const bool kHasLightTree = false;
layout(constant_id = kConstantSampler) const uint kSampler = kSamplerRandom;
layout(constant_id = kConstantTransparency) const bool kHasTransparency = false;
layout(constant_id = kConstantGlass) const bool kHasGlass = false;
layout(constant_id = kConstantPunctual) const uint kPunctualMask = kPunctualLocal | kPunctualDirectional;

// Groups of lights: the environment, directional lights, and local ones, which are emissive triangles, points and spots.
const bool kHasPoints = (kPunctualMask & kPunctualLocal) != 0u;
const bool kHasDirectional = (kPunctualMask & kPunctualDirectional) != 0u;
const bool kHasLocal = kHasEmitters || kHasPoints;
const int kLightGroups = int(kHasEnvironment) + int(kHasDirectional) + int(kHasLocal);

#endif
