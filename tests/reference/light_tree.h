// Choice of a light by the hierarchy of Conty Estevez and Kulla 2018, from the paper, with angles.
#pragma once

#include "tests/reference/math.h"
#include <cstdint>
#include <vector>

namespace irradia::reference {

struct LightNode {
    Vec3 center{0.0}; // of a sphere around its lights
    double radius = 0.0;
    Vec3 axis{0, 0, 1};       // of a cone that holds the directions they emit along
    double spread = 0.0;      // its half angle, the paper's theta_o
    double reach = kPi / 2.0; // and how far they emit beyond it, its theta_e
    double power = 0.0;
    uint32_t child = 0; // the first of two neighbours; of a leaf, its light
    bool isLeaf = false;
};

struct Receiver {
    Vec3 point{0.0};
    Vec3 normal{0, 0, 1}; // unit; light comes from its side alone
};

// Chance of every light to be chosen at a receiver, the root being the first node. They sum to 1, or to less
// where the way down may end at two children neither of which reaches it.
std::vector<double> lightChances(const std::vector<LightNode>& tree, const Receiver& receiver);

} // namespace irradia::reference
