// Hierarchy over local lights, so that a point's light sample goes where light comes from: bounds,
// emission cones and importance of Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with
// Adaptive Tree Splitting", without the splitting. Nodes are bounded by spheres, which is what the
// importance uses.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace irradia {

// Where light goes to, the paper's theta_o and theta_e: along all of a cone, and so far beyond it.
struct EmissionCone {
    glm::dvec3 axis{0, 0, 1};
    double spread = 0.0;                   // its half angle, 0 to pi
    double reach = 0.5 * std::numbers::pi; // up to a right angle
};

// An emissive triangle, counter-clockwise from its front; or a light without extent, at all three corners.
struct TreeLight {
    glm::dvec3 corners[3];
    double power = 0.0; // of a triangle area x luminance x sides; >= 0
    bool isTwoSided = false;
    std::optional<EmissionCone> cone; // of what is no triangle
};

// Cones are wider by this angle than the normals in them: octahedral axes and float cosines near 1 lose less.
inline constexpr double kConeMargin = 5e-4;

struct LightTreeNode {
    glm::dvec3 center{0.0}; // of a sphere around all lights
    double radius = 0.0;
    EmissionCone cone; // its spread holds all of theirs, its reach is the largest
    double power = 0.0;
    uint32_t child = 0; // the first of two neighbouring nodes; of a leaf, its light
    bool isLeaf = false;
};

struct LightTree {
    std::vector<LightTreeNode> nodes; // the root first
    std::vector<uint32_t>
        trails; // per light: bit d = the second child is taken at depth d on the way to its leaf
};

inline constexpr uint32_t kMaxLightTreeDepth = 32; // a trail's bits

// At least one light, fewer than 2^31. One leaf for each.
LightTree buildLightTree(std::span<const TreeLight> lights);

} // namespace irradia
