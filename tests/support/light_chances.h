// The twin of choosing a light, for a hierarchy of the engine.
#pragma once

#include "engine/scene/lights/light_tree.h"
#include "tests/reference/light_tree.h"

namespace irradia::test {

std::vector<double> lightChances(const LightTree& tree, const reference::Receiver& receiver);

} // namespace irradia::test
