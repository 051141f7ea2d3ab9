// Directional albedo of the BSDF by sampling, over roughness and angle, against double-precision quadrature.
#include "kernels/shaders.h"
#include "tests/reference/parallel.h"
#include "tests/support/bsdf_harness.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

using namespace irradia;
using reference::BsdfParameters;
using reference::Vec3;
using test::BsdfCase;

namespace {

// Of a directional albedo by sampling, as relative error. The noise of 128 x 128 jittered samples is below
// 0.1 %, the table of the mend within 0.06 %.
constexpr double kTolerance = 0.005;
constexpr double kMostEnergy = 1.0 + 1e-3;

struct Named {
    const char* name;
    BsdfParameters material; // its roughness is swept
};

const Named kMaterials[] = {
    {"white dielectric", {Vec3(1.0), 0.0, 0.0, Vec3(0.04), 1.0}},
    {"dielectric's specular lobe", {Vec3(0.0), 0.0, 0.0, Vec3(0.04), 1.0}},
    {"white metal", {Vec3(1.0), 1.0, 0.0, Vec3(0.04), 1.0}},
    {"dielectric of F0 near 1", {Vec3(1.0), 0.0, 0.0, Vec3(0.95, 0.7, 0.3), 1.0}},
    {"half metal", {Vec3(0.9, 0.5, 0.1), 0.5, 0.0, Vec3(0.04), 0.8}},
};

constexpr int kGrid = 20;

// Roughness (i / 19)^2, dense where it is small and the lobe changes fastest, times angles up to 88 degrees.
std::vector<BsdfCase> albedoGrid(BsdfParameters material) {
    std::vector<BsdfCase> cases;
    for (int i = 0; i < kGrid; ++i)
        for (int j = 0; j < kGrid; ++j) {
            material.roughness = i * i / double((kGrid - 1) * (kGrid - 1));
            cases.push_back(
                test::bsdfCase(material, std::cos(88.0 / 180.0 * reference::kPi * j / (kGrid - 1))));
        }
    return cases;
}

// Means over strata x strata samples of each case.
std::vector<Vec3> sampledAlbedos(const std::vector<BsdfCase>& cases,
                                 const std::vector<Specialisation>& faults = {}) {
    const uint32_t strata = test::fullSweep() ? 512 : 128;
    test::KernelHarness kernel(kernels::bsdf_albedo, faults);
    const Buffer inputs = test::caseBuffer(cases);
    const uint32_t items = static_cast<uint32_t>(cases.size()) * strata;
    const gpu::BsdfHarnessParams params{items, 0, 1, strata};
    const auto sums = kernel.run({inputs, test::reflectanceTable()}, params, items, items);
    std::vector<Vec3> albedos;
    for (size_t i = 0; i < cases.size(); ++i) {
        Vec3 sum(0.0);
        for (uint32_t row = 0; row < strata; ++row) sum += Vec3(test::toFloats(sums[i * strata + row]));
        albedos.push_back(sum / (double(strata) * strata));
    }
    return albedos;
}

std::vector<Vec3> exactAlbedos(const std::vector<BsdfCase>& cases) {
    std::vector<Vec3> albedos(cases.size());
    reference::parallelFor(static_cast<int>(cases.size()), 0, [&](int i) {
        albedos[i] = reference::directionalAlbedo(cases[i].material, cases[i].view.z);
    });
    return albedos;
}

struct Errors {
    double relative = 0.0; // largest of |sampled - exact| / exact
    double energy = 0.0;   // largest sampled albedo
    std::string where;     // of the first
};

Errors compare(const std::vector<BsdfCase>& cases, const std::vector<Vec3>& sampled,
               const std::vector<Vec3>& exact) {
    Errors errors;
    for (size_t i = 0; i < cases.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            errors.energy = std::max(errors.energy, sampled[i][k]);
            const double relative = std::abs(sampled[i][k] - exact[i][k]) / exact[i][k];
            if (relative <= errors.relative) continue;
            errors.relative = relative;
            errors.where =
                fmt::format("roughness {:.4f}, cosine {:.4f}: sampled {:.5f}, exact {:.5f}",
                            cases[i].material.roughness, cases[i].view.z, sampled[i][k], exact[i][k]);
        }
    return errors;
}

} // namespace

TEST_CASE("directional albedo by sampling equals quadrature and never exceeds 1") {
    for (const Named& m : kMaterials) {
        const std::vector<BsdfCase> cases = albedoGrid(m.material);
        const Errors errors = compare(cases, sampledAlbedos(cases), exactAlbedos(cases));
        INFO(m.name << ": relative error " << errors.relative << " at " << errors.where);
        CHECK(errors.relative < kTolerance);
        CHECK(errors.energy < kMostEnergy);
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("radiance off by 2 % or a density off by 5 % is found in the albedo") {
    const std::vector<BsdfCase> cases = albedoGrid(kMaterials[0].material);
    const std::vector<Vec3> exact = exactAlbedos(cases);
    const auto faulty = [&](uint32_t fault, float factor) {
        return compare(cases, sampledAlbedos(cases, {test::floatConstant(fault, factor)}), exact);
    };
    const Errors radiance = faulty(test::kRadianceFault, 1.02f);
    CHECK(radiance.relative > kTolerance);
    CHECK(radiance.energy > kMostEnergy);
    CHECK(faulty(test::kPdfFault, 1.05f).relative > kTolerance);
    CHECK(faulty(test::kAlphaFault, 1.05f).relative > kTolerance);
}
