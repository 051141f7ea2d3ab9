// Glass: lobes and table.
#include "engine/scene/glass_energy.h"
#include "engine/scene/glass_table.h"
#include "engine/scene/reflectance_table.h"
#include "kernels/shaders.h"
#include "tests/support/bsdf_harness.h"
#include "tests/support/glass_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <fmt/format.h>

using namespace irradia;
using reference::Vec3;
using test::GlassCase;

TEST_CASE("furnace") {
    const auto t0 = std::chrono::steady_clock::now();
    buildGlassTable(buildReflectanceTable());
    fmt::print("table {} ms\n",
               std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count() * 1e3);
    std::vector<GlassCase> cases;
    std::vector<double> etas{0.0};
    for (double e : {1.0, 1.02, 1.1, 1.33, 1.5, 2.4}) {
        etas.push_back(e);
        etas.push_back(1 / e);
    }
    for (double eta : etas)
        for (double r : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0})
            for (double mu : {0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0})
                cases.push_back(eta > 0 ? test::whiteGlass(eta, r, mu) : test::whiteSheet(r, mu));
    const uint32_t strata = 128;
    test::KernelHarness kernel(kernels::glass_albedo);
    const Buffer inputs = test::caseBuffer(cases);
    const uint32_t items = static_cast<uint32_t>(cases.size()) * strata;
    const gpu::BsdfHarnessParams params{items, 0, 1, strata};
    const auto sums =
        kernel.run({inputs, test::reflectanceTable(), test::glassTable()}, params, items, 2 * items);
    for (size_t i = 0; i < cases.size(); ++i) {
        double r = 0, t = 0, w = 0;
        for (uint32_t row = 0; row < strata; ++row) {
            const auto a = test::toFloats(sums[2 * (i * strata + row)]),
                       b = test::toFloats(sums[2 * (i * strata + row) + 1]);
            r += a.x;
            t += b.x;
            w = std::max(w, double(std::max(a.w, b.w)));
        }
        r /= strata * strata;
        t /= strata * strata;
        const auto& c = cases[i];
        const double eta = c.isSheet   ? 1.0
                           : c.eta < 1 ? std::min(c.eta, 1 / 1.001f)
                                       : std::max(c.eta, 1.001f);
        t *= eta * eta;
        if (std::abs(r + t - 1) > 2e-3 || !(r + t < 2))
            fmt::print("{} eta {:.3f} rough {} mu {:.2f}: r {:.4f} t {:.4f} sum {:.4f} max {:.2f}\n",
                       c.isSheet, c.eta, c.roughness, c.view.z, r, t, r + t, w);
    }
}
