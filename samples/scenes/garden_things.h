// What stands in the greenhouse beside its plants.
#pragma once

#include "glb_writer.h"

namespace irradia::scenes {

// A bench of slats along z, from the origin of `place` to `size`.
void addBench(GlbWriter& glb, const glm::mat4& place, glm::vec3 size, int wood);

// Returns its height.
float addStool(GlbWriter& glb, const glm::mat4& place, int wood);

// Closed, of walls 6 mm thick.
Mesh carafe();

// Its spout towards +x.
void addWateringCan(GlbWriter& glb, const glm::mat4& place, int metal);

// Pots of one shape, paler where lime has settled; 0.26 high before scaling.
class Pots {
public:
    explicit Pots(GlbWriter& glb);

    // Returns where its plant grows.
    glm::mat4 place(glm::vec3 at, float scale, float turn);
    // The same with cords from its rim to that height.
    glm::mat4 hang(glm::vec3 at, float scale, float height);

private:
    GlbWriter& glb_;
    int pot_ = 0, cord_ = 0;
};

} // namespace irradia::scenes
