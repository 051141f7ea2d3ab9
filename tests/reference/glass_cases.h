// Glass BSDFs that tests try everything on.
#pragma once

#include "tests/reference/glass.h"
#include <vector>

namespace irradia::reference {

inline Glass whiteSolid(double eta, double roughness) {
    return Glass({Vec3(1.0), 0.0, roughness, Vec3(normalReflectance(eta)), 1.0},
                 {GlassParameters::Kind::Solid, 1.0, eta});
}

inline Glass whiteSheet(double roughness) {
    return Glass({Vec3(1.0), 0.0, roughness, Vec3(0.04), 1.0}, {GlassParameters::Kind::RoughSheet, 1.0});
}

// All lobes at once, coloured.
inline Glass mixed(GlassParameters::Kind kind, double eta, double roughness) {
    const Vec3 f0 = kind == GlassParameters::Kind::Solid ? f0Between({0.05, 0.04, 0.03}, 1.5, eta)
                                                         : Vec3(0.05, 0.04, 0.03);
    return Glass({{0.9, 0.6, 0.3}, 0.25, roughness, f0, 0.8}, {kind, 0.6, eta});
}

inline std::vector<Glass> glasses() {
    return {whiteSolid(1.5, 0.5),
            whiteSolid(1.0 / 1.5, 0.5),
            whiteSheet(0.6),
            mixed(GlassParameters::Kind::Solid, 2.4, 0.8),
            mixed(GlassParameters::Kind::Solid, 1.0 / 1.33, 0.4),
            mixed(GlassParameters::Kind::RoughSheet, 1.0, 0.5),
            mixed(GlassParameters::Kind::ClearSheet, 1.0, 0.5)};
}

} // namespace irradia::reference
