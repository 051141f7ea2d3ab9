// constant_id of the specialisation constants that C++ sets and kernels declare. 0 and 1, the sizes of workgroup and
// subgroup, are engine/gpu/kernel's.
#ifndef IRRADIA_SHARED_CONSTANTS_H
#define IRRADIA_SHARED_CONSTANTS_H
#include "shared/types.h"
SHARED_BEGIN

// Paths: what a scene and a view need of the kernels (path/needs.glsl).
SHARED_CONST uint kConstantEnvironment = 10u; // the environment is not black
SHARED_CONST uint kConstantEmitters = 11u;    // there are emissive triangles
SHARED_CONST uint kConstantTextures = 12u;    // mask of kBaseColorTexture, ...
SHARED_CONST uint kConstantSpecular = 13u;    // some material has a specular lobe
SHARED_CONST uint kConstantView = 14u;        // what is shown: kViewPicture, ...
SHARED_CONST uint kConstantLightTree = 15u;   // there are enough local lights for a hierarchy
SHARED_CONST uint kConstantSampler = 16u;     // where a path's numbers come from: kSamplerRandom, ... (path/sampler.glsl)
SHARED_CONST uint kConstantTransparency = 17u; // some surface lets light straight on through, or has an inside
SHARED_CONST uint kConstantGlass = 18u;        // some surface has lobes beyond it
SHARED_CONST uint kConstantPunctual = 19u;    // lights without extent: mask of kPunctualLocal, ...

// Learning: a slice of an encoding (learning/encode.glsl).
SHARED_CONST uint kConstantSliceInputQuads = 20u; // of a row of inputs
SHARED_CONST uint kConstantSliceFirstInput = 21u;
SHARED_CONST uint kConstantSliceDims = 22u;
SHARED_CONST uint kConstantSliceEncodedQuads = 23u; // of a row of the whole composite
SHARED_CONST uint kConstantSliceFirstQuad = 24u;
SHARED_CONST uint kConstantSlicePaddingQuads = 25u;
// An encoding's own constants: this one and those that follow, in the order in which its .cpp gives them.
SHARED_CONST uint kConstantOwn = 64u;

// Learning: the shape of a network (learning/mlp_shape.glsl).
SHARED_CONST uint kConstantInputQuads = 26u;
SHARED_CONST uint kConstantWidthQuads = 27u;
SHARED_CONST uint kConstantHiddenLayers = 28u;
SHARED_CONST uint kConstantOutputQuads = 29u;
SHARED_CONST uint kConstantOutputActivation = 30u; // kOutputNone, ...
// How its kernels share the work.
SHARED_CONST uint kConstantLaneRows = 31u;        // subgroup form: rows of a lane
SHARED_CONST uint kConstantGroupRows = 32u;       // workgroup form: rows of a workgroup
SHARED_CONST uint kConstantGroupOutputs = 33u;    // workgroup form: outputs whose weights are loaded together
SHARED_CONST uint kConstantOutputsTogether = 34u; // of a block of the weights' gradient
SHARED_CONST uint kConstantQuadsTogether = 35u;   // likewise, workgroup form
SHARED_CONST uint kConstantInputGradient = 36u;   // the gradient by the inputs is wanted

// Learning: the loss.
SHARED_CONST uint kConstantLoss = 37u; // kLossL2, ...
SHARED_CONST uint kConstantLossOutputs = 38u;

SHARED_END
#endif
