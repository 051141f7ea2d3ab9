// Choice of a light by the hierarchy of Conty Estevez and Kulla 2018, from the paper, with angles.
#pragma once

#include "engine/scene/light_tree.h"
#include "tests/reference/math.h"
#include <vector>

namespace irradia::reference {

struct Receiver {
    Vec3 point{0.0};
    Vec3 normal{0, 0, 1}; // unit; light comes from its side alone
};

// Chance of every light to be chosen at a receiver. They sum to 1, or to less where the way down may end at
// two children neither of which reaches it.
std::vector<double> lightChances(const LightTree& tree, const Receiver& receiver);

} // namespace irradia::reference
