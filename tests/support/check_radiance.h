// What the reference measures of small scenes of walls, against answers known in closed form.
#pragma once

#include "tests/reference/measure.h"
#include <catch2/catch_test_macros.hpp>

namespace irradia::reference {

// Within four deviations of its own noise and a relative rounding; planted: 2 % more would not be.
inline void checkRadiance(const Measured& measured, const Vec3& expected, double rounding = 1e-6) {
    for (int c = 0; c < 3; ++c) {
        const double limit = 4.0 * measured.sigma[c] + rounding * expected[c];
        CAPTURE(c, measured.mean[c], measured.sigma[c], expected[c]);
        CHECK(std::abs(measured.mean[c] - expected[c]) <= limit);
        CHECK(std::abs(1.02 * measured.mean[c] - expected[c]) > limit);
    }
}
inline void checkRadiance(const Measured& measured, double expected, double rounding = 1e-6) {
    checkRadiance(measured, Vec3(expected), rounding);
}

// A square of side 2 in the plane z, its front towards +z.
inline void addWall(Scene& scene, const Material& material, float z) {
    addQuad(scene, addMaterial(scene, material), {-1, -1, z}, {2, 0, 0}, {0, 2, 0});
}

} // namespace irradia::reference
