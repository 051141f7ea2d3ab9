// Choice of a light by the hierarchy of Conty Estevez and Kulla 2018, from the paper, with angles.
#pragma once

#include "engine/scene/light_tree.h"
#include "tests/reference/math.h"
#include <vector>

namespace irradia::reference {

// Chance of every light to be chosen at a point. They sum to 1, or are all 0 where no light reaches the
// point; less than 1 where the way down ends at two children of which neither does.
std::vector<double> lightChances(const LightTree& tree, const Vec3& point);

} // namespace irradia::reference
