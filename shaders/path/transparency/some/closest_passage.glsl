// Path rays pass surfaces that let some light straight on through, by chance, and are weakened by the medium they travel in:
// what that leaves of the light from their end is their path's passage.
#include "path/frame.glsl"

FRAME_CONSTANTS(4);
QUADS(5, passages);
QUADS_READ(6, geometry);
QUADS_READ(7, attributes);
QUADS_READ(8, materials);
QUADS_READ(9, textures);
HALVES_READ(10, texels);
#define WAVE params.wave
#include "lib/rng.glsl"
#include "path/media.glsl"
#include "path/transparency/see_through.glsl"
#include "path/wave.glsl"

vec3 left = vec3(1.0); // of this lane's ray

// Sheets that let nearly everything through still reflect: some rays must stop at them.
const float kMostOften = 0.984375;

// A number for each surface that the path's ray may pass.
float passingNumber(uint path, uint primitive) {
    uvec4 bits = randomBits(pixelOf(path), sampleOf(path), lightChoiceBlock(params.wave.depth), frame.seed);
    return unitFloat(pcg(bits.z ^ pcg(primitive)));
}

bool passesSurface(uint path, Traversal ray) {
    SeeThrough surface = seeThrough(ray.primitive, vec2(ray.u, ray.v), ray.direction);
    float chance = surface.coverage > 0.0 ? min(maxComponent(surface.passing), kMostOften) : 1.0;
    bool goesOn = passingNumber(path, ray.primitive) < chance;
    left *= goesOn ? surface.passing / chance : vec3(surface.coverage / (1.0 - chance));
    return goesOn;
}

bool passes(uint slot, inout Traversal ray) {
    uint path = loadQuad(rays, slot * kRayQuads).w;
    bool isHit = ray.primitive != kNoPrimitive;
    bool goesOn = false;
    if (isHit && ray.isTransparent) goesOn = passesSurface(path, ray);
    if (goesOn) {
        resumeTraversal(ray, params.root, kUnbounded);
    } else {
        uint media = params.wave.depth == 0u ? kNoMedia : loadQuad(passages, path).w;
        if (kHasGlass && isHit) left *= transmittanceOf(mediumOfWay(media, ray.primitive, ray.direction), ray.tMax);
        storeQuad(passages, path, uvec4(floatBitsToUint(left), media));
        left = vec3(1.0);
    }
    return goesOn;
}
