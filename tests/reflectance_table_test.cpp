// The reflectance table, as the shaders look it up, against the integrals by quadrature, and what its errors
// do to the energy of the BSDF.
#include "engine/scene/reflectance_table.h"
#include "kernels/shaders.h"
#include "tests/reference/energy_mend.h"
#include "tests/reference/math.h"
#include "tests/reference/parallel.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

using namespace irradia;
using reference::EnergyTable;
using reference::mendFactor;
using reference::SpecularIntegrals;

namespace {

struct LookUp {
    double mu;
    double roughness;
    SpecularIntegrals exact;
    double exactC;
    SpecularIntegrals table; // interpolated by the shader
    double tableC;
};

// Viewers are never below kMinShadingCosine = 0.01 (shaders/path/surface.glsl), so that is where the grid
// starts. Squares gather its points at small cosines and roughnesses.
std::vector<LookUp> lookUps() {
    const int cosines = test::fullSweep() ? 400 : 100, roughnesses = test::fullSweep() ? 200 : 60;
    std::vector<LookUp> grid;
    std::vector<glm::vec4> queries;
    for (int j = 0; j <= roughnesses; ++j)
        for (int i = 0; i <= cosines; ++i) {
            const double x = i / double(cosines), y = j / double(roughnesses);
            const glm::vec2 query(0.01 + 0.99 * x * x, y * y);
            grid.push_back({query.x, query.y, {}, 0.0, {}, 0.0});
            queries.emplace_back(query, 0.0f, 0.0f);
        }
    reference::parallelFor(static_cast<int>(grid.size()), 0, [&](int i) {
        LookUp& point = grid[i];
        point.exact =
            reference::integrateSpecular(point.mu, std::max(point.roughness * point.roughness, 1e-3));
        point.exactC = EnergyTable::instance().diffuse(point.mu);
    });

    test::KernelHarness kernel(kernels::bsdf_reflectance);
    const Buffer inputs = test::quadBuffer(queries), table = test::quadBuffer(buildReflectanceTable());
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(grid.size()), 0, 0, 0};
    const auto results = kernel.run({inputs, table}, params, grid.size(), grid.size());
    for (size_t i = 0; i < grid.size(); ++i) {
        const glm::vec4 abc = test::toFloats(results[i]);
        grid[i].table = {abc.x, abc.y};
        grid[i].tableC = abc.z;
    }
    return grid;
}

const std::vector<LookUp>& grid() {
    static const std::vector<LookUp> points = lookUps();
    return points;
}

// What a white dielectric reflects in excess of what it receives: its exact specular albedo and the Lambert
// lobe with the mend from the table.
double excess(const LookUp& p, double specular, double f0) {
    const double diffuse = 1.0 - specular * (f0 * (1.0 - p.exactC) + p.exactC);
    return specular * (f0 * p.exact.a + p.exact.b) + diffuse * mendFactor(specular, f0, p.table, p.tableC) -
           1.0;
}

} // namespace

TEST_CASE("A, B and C are within 1e-3 of the integrals at every cosine and roughness of a viewer") {
    double a = 0.0, b = 0.0, c = 0.0;
    for (const LookUp& p : grid()) {
        a = std::max(a, std::abs(p.table.a - p.exact.a));
        b = std::max(b, std::abs(p.table.b - p.exact.b));
        c = std::max(c, std::abs(p.tableC - p.exactC));
    }
    INFO(fmt::format("largest errors: A {:.2e}, B {:.2e}, C {:.2e}", a, b, c));
    CHECK(a < 1e-3);
    CHECK(b < 1e-3);
    CHECK(c < 1e-4); // no lobe in it: it is smooth
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("the mend with the table's errors lets no more than 1e-3 of energy through") {
    double worst = 0.0;
    std::string where;
    for (const LookUp& p : grid())
        for (const double specular : {0.3, 0.7, 1.0})
            for (const double f0 : {0.0, 0.02, 0.04, 0.1, 0.3, 0.6, 0.9})
                if (const double e = excess(p, specular, f0); e > worst) {
                    worst = e;
                    where = fmt::format("roughness {:.4f}, cosine {:.4f}, F0 {}, specular {}", p.roughness,
                                        p.mu, f0, specular);
                }
    INFO(fmt::format("excess {:.2e} at {}", worst, where));
    CHECK(worst < 1e-3);
}

TEST_CASE("without the mend a smooth white dielectric would reflect 1.77 at 88 degrees") {
    const double mu = std::cos(88.0 / 180.0 * reference::kPi), c = EnergyTable::instance().diffuse(mu);
    const SpecularIntegrals exact = reference::integrateSpecular(mu, 1e-3);
    const double unmended = 0.04 * exact.a + exact.b + 1.0 - (0.04 * (1.0 - c) + c);
    CHECK(std::abs(unmended - 1.77) < 0.01);
}
