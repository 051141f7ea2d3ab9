// Nobody listens at the vertices of paths. What any tap provides here (TAP_BINDING is its first binding, those of tap_light.glsl
// come first):
#include "path/surface.glsl"

struct Visit {
    bool goesOn;  // the path leaves the vertex
    bool listens; // to light that counts for nothing in the picture, too
};

// A path arrives at a vertex by a ray of that length and density, whose passage leaves that of the light. `beta` is the path's
// weight for the picture, and becomes that of what follows: 0 where the picture's path ends. All lanes of a subgroup come
// here.
Visit arrive(bool alive, uint path, uint pixel, Surface s, vec3 view, float rayLength, float pdf, vec3 passage,
             inout vec3 beta) {
    return Visit(alive, false);
}

// Probability with which Russian roulette lets the path go on, where the picture's would be `survival`.
float survivalOf(Visit visit, float survival, vec3 throughput) { return survival; }

// Whether the path goes on although it is worth nothing to the picture.
bool goesOnUnseen(Visit visit, vec3 throughput) { return false; }

// The path leaves the vertex: with a light sample, as it arrives if nothing is in between, and with a ray.
void leave(Visit visit, vec3 directLight, vec3 throughput) {}
