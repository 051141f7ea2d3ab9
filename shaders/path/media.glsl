// The insides of solids that a path's ray is in: the two innermost, 16 bits each, a medium being the number of its material
// + 1 (0 = none, as for those beyond). Inside and outside are told by the faces' orientation. Bindings as scene.glsl.
#ifndef IRRADIA_PATH_MEDIA_GLSL
#define IRRADIA_PATH_MEDIA_GLSL
#include "lib/glass.glsl"
#include "path/scene.glsl"

const uint kNoMedia = 0u;

uint innermost(uint media) { return media & 0xffffu; }
uint beneath(uint media) { return media >> 16u; }

// The medium of a material's inside.
uint mediumOf(uint material) {
    uint flags = loadQuad(materials, material * kMaterialQuads + 3u).y;
    return (flags & kMaterialSolid) != 0u && material < 0xffffu ? material + 1u : 0u;
}

// Of light that goes as far in a medium (Beer and Lambert).
vec3 transmittanceOf(uint medium, float distance) {
    vec3 absorption = uintBitsToFloat(loadQuad(materials, (max(medium, 1u) - 1u) * kMaterialQuads + 6u).rgb);
    return medium == 0u ? vec3(1.0) : exp(-absorption * distance);
}

// Of refraction. glTF's 0 stands for what reflects all.
float indexOf(uint medium) {
    float index = uintBitsToFloat(loadQuad(materials, (max(medium, 1u) - 1u) * kMaterialQuads + 5u).w);
    return medium == 0u ? 1.0 : (index > 0.0 ? index : 1000.0);
}

// What a ray that ends at a primitive travels in: the inside of what it meets from behind.
uint mediumOfWay(uint media, uint primitive, vec3 direction) {
    TriangleGeometry tri = loadTriangle(primitive);
    uint inside = mediumOf(tri.material);
    bool isBehind = dot(cross(tri.e1, tri.e2), direction) > 0.0;
    return isBehind && inside != 0u ? inside : innermost(media);
}

// Media behind a surface with an inside: of light that goes in, or out, through it.
uint mediaWithin(uint media, uint inside) { return inside | innermost(media) << 16u; }

uint mediaWithout(uint media, uint inside) {
    if (innermost(media) == inside) return beneath(media);
    return beneath(media) == inside ? innermost(media) : media;
}

// Of light that is reflected in it.
uint mediaReflected(uint media, uint inside) { return innermost(media) == inside ? media : mediaWithin(media, inside); }

// What a face parts, as light meets it: the media on either side of a solid's; all others have the same on both.
struct Interface {
    uint here; // media
    uint beyond;
    float index;  // of refraction of the solid
    float eta;    // the index beyond over that here
    bool isSolid;
};

Interface interfaceOf(uint media, uint material, bool isFront) {
    uint inside = mediumOf(material);
    uint outside = isFront ? media : mediaWithout(media, inside);
    Interface face;
    face.isSolid = inside != 0u;
    face.here = isFront || inside == 0u ? media : mediaReflected(media, inside);
    face.beyond = inside == 0u ? media : (isFront ? mediaWithin(media, inside) : outside);
    face.index = indexOf(inside);
    float eta = awayFromOne(face.index / indexOf(innermost(outside))); // alike on the way in and out
    face.eta = isFront ? eta : 1.0 / eta;
    return face;
}

#endif
