// What rough glass loses by single scattering: the table, as the shaders look it up, against quadrature.
#include "engine/scene/glass_table.h"
#include "kernels/shaders.h"
#include "tests/reference/energy_mend.h"
#include "tests/reference/interface_integrals.h"
#include "tests/reference/parallel.h"
#include "tests/reference/random.h"
#include "tests/support/bsdf_harness.h"
#include "tests/support/glass_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

using namespace irradia;
using reference::Vec3;
using test::GlassCase;

namespace {

struct LookUp {
    glm::vec4 query; // cosine, alpha, eta, 1 of sheets
    double loss;     // interpolated by the shader
    double mean;
};

std::vector<LookUp> lookUp(const std::vector<glm::vec4>& queries) {
    test::KernelHarness kernel(kernels::glass_losses);
    const Buffer inputs = test::quadBuffer(queries);
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(queries.size()), 0, 0, 0};
    const auto results = kernel.run({inputs, test::glassTable()}, params, queries.size(), queries.size());
    std::vector<LookUp> lookUps;
    for (size_t i = 0; i < queries.size(); ++i) {
        const glm::vec4 result = test::toFloats(results[i]);
        lookUps.push_back({queries[i], result.x, result.y});
    }
    return lookUps;
}

double exactLoss(double mu, double alpha, double eta) {
    const double f0 = reference::normalReflectance(eta);
    const auto albedo = reference::integrateInterface(mu, alpha, {Vec3(f0), 1.0, eta});
    return 1.0 - albedo.reflected.x - albedo.transmitted;
}

} // namespace

TEST_CASE("table") {
    reference::Random random(5);
    std::vector<glm::vec4> queries;
    for (int i = 0; i < 6000; ++i) {
        const double u = random.uniform(), r = random.uniform(), w = random.uniform();
        const double sparse = 1.0 - (1.0 - 1.0 / 2.6) * (i % 3 ? w * w : w * w * w * w);
        queries.emplace_back(0.01 + 0.99 * u * u, std::max(r * r * r * r, 1e-3),
                             i % 2 ? sparse : 1.0 / sparse, 0.0);
    }
    auto points = lookUp(queries);
    std::vector<double> errors(points.size()), exact(points.size());
    reference::parallelFor(int(points.size()), 0, [&](int i) {
        const auto& q = points[i].query;
        exact[i] = exactLoss(q.x, q.y, q.z);
        errors[i] = points[i].loss - exact[i];
    });
    for (int side = 0; side < 2; ++side) {
        std::vector<int> order;
        double sum = 0;
        for (size_t i = 0; i < points.size(); ++i)
            if ((points[i].query.z < 1) == (side == 1)) {
                order.push_back(int(i));
                sum += errors[i] * errors[i];
            }
        std::sort(order.begin(), order.end(),
                  [&](int a, int b) { return std::abs(errors[a]) > std::abs(errors[b]); });
        fmt::print("side {} rms {:.2e} 1% {:.1e} 5% {:.1e}\n", side, std::sqrt(sum / double(order.size())),
                   errors[order[order.size() / 100]], errors[order[order.size() / 20]]);
        for (int i = 0; i < 12; ++i) {
            auto& q = points[order[i]].query;
            fmt::print("  mu {:.3f} alpha {:.4f} eta {:.4f}: {:.4f} {:+.2e}\n", q.x, q.y, q.z,
                       exact[order[i]], errors[order[i]]);
        }
    }
}
