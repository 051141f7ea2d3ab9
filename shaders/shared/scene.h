// The scene on the GPU: quads (uvec4) in texel-viewable buffers. Written by engine/scene/gpu_scene, read by
// shaders/path/scene.glsl. Directions are octahedral, two 16-bit snorms in a uint (Cigolle et al. 2014).
#ifndef IRRADIA_SHARED_SCENE_H
#define IRRADIA_SHARED_SCENE_H
#include "shared/types.h"
SHARED_BEGIN

// Triangle geometry, world space:
//   0: p0 xyz, material index
//   1: e1 = p1 - p0, light index (kNoLight = does not emit)
//   2: e2 = p2 - p0, tangent handedness (bit i set = vertex i has w < 0)
//   3: shading normals of the three vertices (octahedral), unused
SHARED_CONST uint kGeometryQuads = 4u;
SHARED_CONST uint kNoLight = 0xffffffffu;

// Triangle attributes, only in scenes with textures or vertex colours:
//   0: uv set 0 of vertices 0 and 1;  1: uv set 0 of vertex 2, uv set 1 of vertex 0
//   2: uv set 1 of vertices 1 and 2;  3: tangents of the three vertices (octahedral; 0 = none), unused
// and in scenes with vertex colours besides, RGBA as four 16-bit floats each:
//   4: colours of vertices 0 and 1;   5: colour of vertex 2, unused
SHARED_CONST uint kAttributeQuads = 4u;
SHARED_CONST uint kColouredAttributeQuads = 6u;
SHARED_CONST uint kNoTangent = 0x80008000u; // a code octahedral snorm encoding never makes

// Material:
//   0: base colour rgb, metallic            1: emission rgb (radiance), roughness
//   2: dielectric F0 rgb = ((ior-1)/(ior+1))^2 * specular colour, specular factor
//   3: normal scale, flags, alpha, alpha cutoff
//   4: texture of base colour, metallic-roughness, normal, emissive
//   5: texture of specular, specular colour, transmission; index of refraction
//   6: absorption rgb of its inside, transmission
// A texture is (texture quad index << 1 | uv set), or kNoTexture.
SHARED_CONST uint kMaterialQuads = 7u;
SHARED_CONST uint kMaterialDoubleSided = 1u;
SHARED_CONST uint kMaterialMask = 2u;  // its alpha is all or nothing,
SHARED_CONST uint kMaterialBlend = 4u; // or the share that is there
SHARED_CONST uint kMaterialUnlit = 8u; // its emission is times the vertices' colour
SHARED_CONST uint kMaterialSheet = 16u; // lets light through, and has no inside
SHARED_CONST uint kMaterialSolid = 32u; // lets light into its inside
SHARED_CONST uint kNoTexture = 0xffffffffu;

// Texture, 1 quad: first texel, width, height, wrap s | wrap t << 2 (0 repeat, 1 mirror, 2 clamp) | transform << 4.
// A transform is the quad where it stands, behind all textures (0 = none), 2 quads: the columns of uv' = M uv + offset, and
// the offset. Texels are four 16-bit floats, linear.

// Local light, an emissive triangle or one without extent, 1 quad: trail, unused, primitive or kPunctual | punctual light,
// unused. A trail leads from the root of the hierarchy of lights to the light's leaf: bit d = the second child is taken at
// depth d. Scenes of few lights have no hierarchy, but an alias table over power (Vose 1991):
//   keep probability (float), alias (light index), as above, probability mass of this light (float)
// Node of that hierarchy, from quad lightCount on, the root first (engine/scene/lights/light_tree):
//   0: centre and radius of a sphere around its lights
//   1: axis (octahedral) and spread of a cone that holds the normals they emit along, power (share of all), first of two
//      children or kLightLeaf | light index
// The spread is a cosine. Where there are points or spots it shares its bits with how far light reaches beyond the cone,
// which else is a right angle: sines of half of the angles (two 16-bit unorms, rounded up; packUnorm2x16).
SHARED_CONST uint kLightNodeQuads = 2u;
SHARED_CONST uint kLightLeaf = 0x80000000u;
SHARED_CONST uint kPunctual = 0x80000000u;

// Punctual light, from quad firstPunctual of the lights on, the directional ones first:
//   0: position, 1 / range (0 = none)
//   1: intensity rgb, 1 / (cos inner - cos outer)
//   2: direction it shines along, cos outer (of points such that they are within)
// A directional one is an entry of an alias table over luminance:
//   0: direction it comes from, keep probability   1: irradiance rgb, probability mass   2: alias, unused
SHARED_CONST uint kPunctualQuads = 3u;
// Which kinds there are (specialisation constant kPunctualMask).
SHARED_CONST uint kPunctualLocal = 1u; // points and spots
SHARED_CONST uint kPunctualDirectional = 2u;

// Environment texel, 1 quad: radiance rgb, density = probability mass * texel count (float).
// Environment alias table, 1 quad per texel: keep probability (float), alias, unused.
// Area table, 1 quad per triangle, an entry of the alias table over area: keep probability (float), alias, unused.
// Only where surfaces are sampled.

// Which textures and vertex attributes any material of the scene uses (specialisation constant kTextureMask).
SHARED_CONST uint kBaseColorTexture = 1u;
SHARED_CONST uint kMetallicRoughnessTexture = 2u;
SHARED_CONST uint kNormalTexture = 4u;
SHARED_CONST uint kEmissiveTexture = 8u;
SHARED_CONST uint kSpecularTexture = 16u;
SHARED_CONST uint kSpecularColorTexture = 32u;
SHARED_CONST uint kTransmissionTexture = 64u;
SHARED_CONST uint kVertexColors = 128u;
SHARED_CONST uint kTextureTransforms = 256u;
SHARED_CONST uint kAllAttributes = 511u;

SHARED_CONST float kMinAlpha = 1e-3f; // GGX alpha = roughness^2 is at least this

// Reflectance table of the specular and diffuse lobes (engine/scene/reflectance_table): A, B, C over a grid of
//   column x = (2 sqrt(mu) + sqrt(mu (1 + 8 alpha) / (mu + 8 alpha))) / 3  of the cosine mu,
//   row y = (sqrt(roughness) - r0) / (1 - r0),  r0 = kMinAlpha^(1/4)  of the perceptual roughness,
// both from 0 to 1, row j after row j - 1. The second root keeps what depends on mu / alpha in a column: so bilinear
// interpolation at mu >= 0.01 is within 1e-3 of the integrals, which bounds the energy the mend lets through.
SHARED_CONST uint kTableCosines = 64u;
SHARED_CONST uint kTableRoughnesses = 48u;
SHARED_CONST float kTableAlphaScale = 8.0f;
SHARED_CONST float kTableFirstRoot = 0.17782794f; // r0

SHARED_END
#endif
