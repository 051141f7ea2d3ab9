// A greenhouse that leans against a wall at its +x side: a roof of glass slopes down to a wall of glass at -x
// and ends in a gable of glass at -z; the +z end is walled.
#pragma once

#include "glb_writer.h"

namespace irradia::scenes {

// Of the inside.
struct LeanTo {
    glm::vec3 lower, upper; // the roof's highest line lies at upper.x, upper.y
    float plinth, eave;     // heights between which the low side has panes

    float roof(float x) const { return eave + (upper.y - eave) * (x - lower.x) / (upper.x - lower.x); }
};

struct LeanToMaterials {
    int frame, plinth, wall, bricks;
    int clear, green, amber, frosted; // glass
};

void addLeanTo(GlbWriter& glb, const LeanTo& house, const LeanToMaterials& materials);

} // namespace irradia::scenes
