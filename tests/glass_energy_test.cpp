// The energy of glass: the table of what single scattering loses, as the shaders look it up, against
// quadrature, and directional albedos by sampling.
#include "kernels/shaders.h"
#include "shared/glass_table.h"
#include "tests/reference/glass_albedo.h"
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

// ---- Table -------------------------------------------------------------------------------------------

struct Losses {
    double loss; // 1 - E, interpolated by the shader
    double mean; // of it
};

// Queries are (cosine, alpha, eta, 1 of sheets).
std::vector<Losses> lookUp(const std::vector<glm::vec4>& queries) {
    test::KernelHarness kernel(kernels::glass_losses);
    const Buffer inputs = test::quadBuffer(queries);
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(queries.size()), 0, 0, 0};
    std::vector<Losses> losses;
    for (const glm::uvec4& result :
         kernel.run({inputs, test::glassTable()}, params, queries.size(), queries.size()))
        losses.push_back({test::toFloats(result).x, test::toFloats(result).y});
    return losses;
}

double exactLoss(double mu, double alpha, double eta) {
    const double f0 = reference::normalReflectance(eta);
    const auto albedo = reference::integrateInterface(mu, alpha, {Vec3(f0), 1.0, eta});
    return 1.0 - albedo.reflected.x - albedo.transmitted;
}

// eta of w = 1 - min(eta, 1 / eta) in [0, 1], a share of the table's range.
double indexOf(double w, bool isDense) {
    const double sparse = 1.0 - (1.0 - 1.0 / gpu::kGlassMaxIndex) * w;
    return isDense ? sparse : 1.0 / sparse;
}

// ---- Albedos -----------------------------------------------------------------------------------------

struct Albedo {
    Vec3 reflected{0.0}, transmitted{0.0}; // shares of light: of radiance times (n_l / n_v)^2
    double heaviest = 0.0;                 // f cos / pdf of a sample

    Vec3 sum() const { return reflected + transmitted; }
};

// Means over 128 x 128 samples of each case.
std::vector<Albedo> sampledAlbedos(const std::vector<GlassCase>& cases,
                                   const std::vector<Specialisation>& faults = {}) {
    const uint32_t strata = test::fullSweep() ? 512 : 128;
    test::KernelHarness kernel(kernels::glass_albedo, faults);
    const Buffer inputs = test::caseBuffer(cases);
    const uint32_t items = static_cast<uint32_t>(cases.size()) * strata;
    const gpu::BsdfHarnessParams params{items, 0, 1, strata};
    const auto sums =
        kernel.run({inputs, test::reflectanceTable(), test::glassTable()}, params, items, 2 * items);
    std::vector<Albedo> albedos(cases.size());
    for (size_t i = 0; i < cases.size(); ++i) {
        Albedo& albedo = albedos[i];
        for (size_t row = i * strata; row < (i + 1) * strata; ++row) {
            const glm::vec4 reflected = test::toFloats(sums[2 * row]),
                            transmitted = test::toFloats(sums[2 * row + 1]);
            albedo.reflected += Vec3(reflected);
            albedo.transmitted += Vec3(transmitted);
            albedo.heaviest = std::max<double>(albedo.heaviest, std::max(reflected.w, transmitted.w));
        }
        const double samples = double(strata) * strata, eta = cases[i].isSheet ? 1.0 : cases[i].eta;
        albedo.reflected /= samples;
        albedo.transmitted *= eta * eta / samples;
    }
    return albedos;
}

// White sheets and, from both sides, solids.
std::vector<GlassCase> whiteCases() {
    std::vector<GlassCase> cases;
    for (const double roughness : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0})
        for (const double mu : {0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
            cases.push_back(test::whiteSheet(roughness, mu));
            for (const double eta : {1.02, 1.1, 1.33, 1.5, 2.4}) {
                cases.push_back(test::whiteGlass(eta, roughness, mu));
                cases.push_back(test::whiteGlass(1.0 / eta, roughness, mu));
            }
        }
    return cases;
}

struct Worst {
    double error = 0.0; // of an albedo, absolute
    double heaviest = 0.0;
    std::string where;
};

template <typename Expected>
Worst worstOf(const std::vector<GlassCase>& cases, const std::vector<Albedo>& albedos, Expected&& errorOf) {
    Worst worst;
    for (size_t i = 0; i < cases.size(); ++i) {
        worst.heaviest = std::max(worst.heaviest, albedos[i].heaviest);
        const double error = reference::maxComponent(glm::abs(errorOf(i)));
        if (error <= worst.error) continue;
        worst.error = error;
        worst.where =
            fmt::format("eta {:.3f}{}, roughness {:.3f}, cosine {:.3f}: reflected {:.4f}, transmitted {:.4f}",
                        cases[i].eta, cases[i].isSheet ? " (sheet)" : "", cases[i].roughness, cases[i].view.z,
                        albedos[i].reflected.x, albedos[i].transmitted.x);
    }
    return worst;
}

// The noise of the samples is about 0.1 %, the error of 1 - E within 0.4 %.
constexpr double kTolerance = 0.005;

Worst furnace(const std::vector<Specialisation>& faults = {}) {
    const std::vector<GlassCase> cases = whiteCases();
    const std::vector<Albedo> albedos = sampledAlbedos(cases, faults);
    return worstOf(cases, albedos, [&](size_t i) { return albedos[i].sum() - 1.0; });
}

} // namespace

TEST_CASE("1 - E is that of quadrature at every cosine of a viewer, alpha and index") {
    reference::Random random(5);
    std::vector<glm::vec4> queries;
    const int count = test::fullSweep() ? 60000 : 6000;
    for (int i = 0; i < count; ++i) {
        const double mu = random.uniform(), rough = random.uniform(), w = random.uniform();
        // Powers gather queries where 1 - E bends: at grazing angles, on smooth surfaces, near eta = 1.
        queries.emplace_back(0.01 + 0.99 * mu * mu, std::max(std::pow(rough, 4.0), 1e-3),
                             indexOf(std::pow(w, i % 3 ? 2.0 : 4.0), i % 2 == 1), 0.0);
    }
    const std::vector<Losses> losses = lookUp(queries);
    std::vector<double> errors(queries.size());
    reference::parallelFor(count, 0, [&](int i) {
        const glm::vec4& q = queries[i];
        errors[i] = std::abs(losses[i].loss - exactLoss(q.x, q.y, q.z));
    });
    for (const int side : {0, 1}) {
        std::vector<double> sorted;
        for (size_t i = side; i < errors.size(); i += 2) sorted.push_back(errors[i]);
        std::ranges::sort(sorted);
        const double worst = sorted.back(), most = sorted[sorted.size() * 99 / 100],
                     median = sorted[sorted.size() / 2];
        INFO(fmt::format("{}: worst {:.2e}, 99 % within {:.2e}, half within {:.2e}",
                         side ? "inside" : "outside", worst, most, median));
        CHECK(worst < 4e-3);
        CHECK(most < 2e-3);
        CHECK(median < 3e-4);
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("the mean of 1 - E is that of what is looked up, so that the furnace closes") {
    constexpr int kSteps = 400;
    struct Mean {
        double alpha, eta, sum = 0.0, largest = 0.0;
    };
    std::vector<Mean> means;
    std::vector<glm::vec4> queries;
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j <= 24; ++j) {
            const double alpha = std::pow(0.18 + 0.82 * (i + 0.37 * (i < 12)) / 12.0, 4.0);
            means.push_back({alpha, indexOf(std::pow((j / 2 + 0.2) / 12.2, 2.0), j % 2 == 1)});
            for (int k = 0; k < kSteps; ++k) // 2 mu dmu = dmu^2, steps even in mu^(1 / 4)
                queries.emplace_back(std::pow((k + 0.5) / kSteps, 4.0), alpha, means.back().eta, 0.0);
        }
    const std::vector<Losses> losses = lookUp(queries);
    double worst = 0.0, worstEnergy = 0.0;
    for (size_t i = 0; i < means.size(); ++i) {
        for (int k = 0; k < kSteps; ++k) {
            const double from = std::pow(k / double(kSteps), 8.0),
                         to = std::pow((k + 1) / double(kSteps), 8.0);
            means[i].sum += losses[i * kSteps + k].loss * (to - from);
            if (queries[i * kSteps + k].x >= 0.01f)
                means[i].largest = std::max(means[i].largest, losses[i * kSteps + k].loss);
        }
        const double error = std::abs(losses[i * kSteps].mean / means[i].sum - 1.0);
        worst = std::max(worst, error);
        worstEnergy = std::max(worstEnergy, error * means[i].largest);
    }
    INFO(fmt::format("relative error of the mean {:.2e}, of a viewer's energy {:.2e}", worst, worstEnergy));
    CHECK(worst < 0.03);
    CHECK(worstEnergy < 3e-3);
}

TEST_CASE("white rough glass in a white furnace is white, seen from outside and inside") {
    const Worst worst = furnace();
    INFO("error " << worst.error << " at " << worst.where << "; heaviest sample " << worst.heaviest);
    CHECK(worst.error < kTolerance);
    CHECK(worst.heaviest < 20.0);
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("radiance off by 2 % or a density off by 5 % is found in the furnace") {
    CHECK(furnace({test::floatConstant(test::kRadianceFault, 1.02f)}).error > kTolerance);
    CHECK(furnace({test::floatConstant(test::kPdfFault, 1.05f)}).error > kTolerance);
}

TEST_CASE("without the light scattered many times, rough glass would lose up to two thirds") {
    CHECK(std::abs(exactLoss(1.0, 1.0, 1 / 2.4) - 0.69) < 0.01);
    CHECK(std::abs(exactLoss(0.3, 1.0, 1.5) - 0.296) < 0.01);
}

TEST_CASE("tinted glass loses of what it transmits what its colour takes, and nothing of what it reflects") {
    const std::vector<GlassCase> white = whiteCases();
    std::vector<GlassCase> tinted = white;
    const Vec3 base(0.9, 0.5, 0.1);
    for (GlassCase& c : tinted) c.base = glm::vec3(base);
    const std::vector<Albedo> a = sampledAlbedos(white), b = sampledAlbedos(tinted);
    const Worst worst = worstOf(tinted, b, [&](size_t i) {
        return glm::max(glm::abs(b[i].reflected - a[i].reflected),
                        glm::abs(b[i].transmitted - base * a[i].transmitted));
    });
    INFO("error " << worst.error << " at " << worst.where);
    CHECK(worst.error < kTolerance);
}

TEST_CASE("directional albedos of mixed materials equal quadrature") {
    std::vector<GlassCase> cases;
    for (const double eta : {0.0, 1.5, 1 / 1.5})
        for (const double roughness : {0.0, 0.5})
            for (const double mu : {0.05, 0.3, 0.6, 0.8, 1.0}) {
                GlassCase c =
                    eta > 0.0 ? test::whiteGlass(eta, roughness, mu) : test::whiteSheet(roughness, mu);
                c.base = {0.8f, 0.5f, 0.3f};
                c.transmission = 0.6f;
                c.metallic = 0.25f;
                c.specular = 0.7f;
                cases.push_back(c);
            }
    const std::vector<Albedo> albedos = sampledAlbedos(cases);
    std::vector<reference::GlassAlbedo> exact;
    for (const GlassCase& c : cases) {
        using Kind = reference::GlassParameters::Kind;
        const Kind kind = !c.isSheet ? Kind::Solid : c.roughness > 0.0f ? Kind::RoughSheet : Kind::ClearSheet;
        const reference::BsdfParameters surface{Vec3(c.base), c.metallic, c.roughness, Vec3(c.f0),
                                                c.specular};
        exact.push_back(reference::directionalAlbedo(
            reference::Glass(surface, {kind, c.transmission, c.isSheet ? 1.0 : double(c.eta)}), c.view.z));
    }
    const Worst worst = worstOf(cases, albedos, [&](size_t i) {
        return glm::max(glm::abs(albedos[i].reflected - exact[i].reflected),
                        glm::abs(albedos[i].transmitted - exact[i].transmitted));
    });
    INFO("error " << worst.error << " at " << worst.where);
    CHECK(worst.error < kTolerance);
}
