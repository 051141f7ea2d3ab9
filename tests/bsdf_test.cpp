// The BSDF of the shaders against its double-precision twin: values, reciprocity, densities and what it
// samples.
#include "kernels/shaders.h"
#include "tests/reference/energy_mend.h"
#include "tests/reference/random.h"
#include "tests/reference/sphere_histogram.h"
#include "tests/support/bsdf_harness.h"
#include "tests/support/gpu_rounding.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

using namespace irradia;
using reference::BsdfParameters;
using reference::Lobes;
using reference::Vec3;
using test::BsdfCase;
using test::BsdfEvaluation;

namespace {

double rounding() { // of one operation in single precision, relative
    return test::divisionSlack() * 0x1p-24;
}

reference::Ggx lobeOf(const BsdfCase& c) {
    return {reference::Bsdf(c.material).alpha()};
}

struct Sweep {
    std::vector<BsdfCase> cases;
    std::vector<glm::vec3> directions;
};

// Random materials, views and directions; half of the directions drawn from the GGX lobe, where it is large.
Sweep randomSweep(size_t count) {
    reference::Random random(7);
    const auto color = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()); };
    Sweep sweep;
    while (sweep.cases.size() < count) {
        BsdfParameters p;
        p.baseColor = color();
        p.metallic = std::clamp(1.5 * random.uniform() - 0.25, 0.0, 1.0);
        p.roughness = random.uniform();
        p.f0 = random.uniform() < 0.5 ? Vec3(0.04) : color();
        p.specular = random.uniform();
        const BsdfCase c = test::bsdfCase(p, 0.01 + 0.99 * random.uniform(), 6.0 * random.uniform());
        const Vec3 v(c.view);
        glm::vec3 l(reference::direction(0.01 + 0.99 * random.uniform(), 6.0 * random.uniform()));
        if (sweep.cases.size() % 2 == 0)
            l = glm::vec3(
                glm::normalize(reference::reflect(v, lobeOf(c).sampleVisibleNormal(v, random.uniform2()))));
        if (l.z < 0.01f) continue;
        sweep.cases.push_back(c);
        sweep.directions.push_back(l);
    }
    return sweep;
}

// Relative error of D, and so of f and of the density: rounding v + l turns h by about rounding() / |v + l|,
// and a turn by delta changes 1 / (alpha^2 + tan^2)^2 by at most 2 delta / alpha. All else is a few dozen
// roundings.
double lobeTolerance(const BsdfCase& c, const glm::vec3& l) {
    return rounding() * (64.0 + 8.0 / (lobeOf(c).alpha * glm::length(Vec3(c.view) + Vec3(l))));
}

// s of one direction, as reference::Bsdf has it.
double mendOf(const BsdfCase& c, double mu) {
    const auto& table = reference::EnergyTable::instance();
    return reference::mendFactor(c.material.specular, reference::maxComponent(c.material.f0),
                                 table.specular(mu, lobeOf(c).alpha), table.diffuse(mu));
}

// f cos of the twin with the mend that the GPU took from its table (whose errors reflectance_table_test
// bounds).
Vec3 expectedValue(const BsdfCase& c, const Vec3& l, double mend) {
    const reference::Bsdf bsdf(c.material);
    const Vec3 v(c.view);
    const double exactMend = std::min(mendOf(c, v.z), mendOf(c, l.z));
    const Vec3 diffuse =
        exactMend > 0.0 ? bsdf.evaluate(v, l, Lobes::Diffuse) * (mend / exactMend) : Vec3(0.0);
    return l.z * (diffuse + bsdf.evaluate(v, l, Lobes::DielectricSpecular) +
                  bsdf.evaluate(v, l, Lobes::MetalSpecular));
}

// Both lobes' densities, mixed by the GPU's probability of the GGX lobe: any choice of it is right.
double expectedPdf(const BsdfCase& c, const Vec3& l, double pSpecular) {
    if (l.z <= 0.0) return 0.0;
    return (1.0 - pSpecular) * l.z / reference::kPi + pSpecular * lobeOf(c).reflectedPdf(Vec3(c.view), l);
}

// Values that are off by more than their tolerance.
int countWrong(const Sweep& sweep, const std::vector<BsdfEvaluation>& values) {
    int wrong = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const BsdfCase& c = sweep.cases[i];
        const Vec3 l(sweep.directions[i]);
        const double tolerance = lobeTolerance(c, sweep.directions[i]);
        const auto isOff = [&](double value, double expected) {
            return !(std::abs(value - expected) <= tolerance * expected + 1e-12);
        };
        const Vec3 value = expectedValue(c, l, values[i].mend);
        bool off = isOff(values[i].pdf, expectedPdf(c, l, values[i].pSpecular));
        for (int k = 0; k < 3; ++k) off = off || isOff(values[i].fCos[k], value[k]);
        wrong += off;
    }
    return wrong;
}

// ---- Sampling
// ---------------------------------------------------------------------------------------------------

struct SamplingCase {
    const char* name;
    BsdfParameters material;
    double degrees; // of the view direction from the normal
    double
        histogramScale; // angle that the bins resolve around the mirror direction; 1 = bins around the normal
};

const SamplingCase kSamplingCases[] = {
    {"rough dielectric from above", {Vec3(0.8), 0.0, 1.0, Vec3(0.04), 1.0}, 0.0, 1.0},
    {"rough dielectric", {Vec3(0.8), 0.0, 0.8, Vec3(0.04), 1.0}, 60.0, 1.0},
    {"satin dielectric", {Vec3(0.8), 0.0, 0.5, Vec3(0.04), 1.0}, 45.0, 1.0},
    {"satin dielectric, grazing", {Vec3(0.2), 0.0, 0.4, Vec3(0.04), 1.0}, 85.0, 1.0},
    {"glossy dielectric", {Vec3(0.5), 0.0, 0.2, Vec3(0.04), 1.0}, 70.0, 0.05},
    {"smooth dielectric", {Vec3(0.05), 0.0, 0.0, Vec3(0.04), 1.0}, 30.0, 2e-3},
    {"smooth dielectric, grazing", {Vec3(0.5), 0.0, 0.05, Vec3(0.04), 1.0}, 88.0, 5e-3},
    {"rough metal", {Vec3(0.9, 0.6, 0.3), 1.0, 1.0, Vec3(0.04), 1.0}, 75.0, 1.0},
    {"satin metal", {Vec3(0.9, 0.6, 0.3), 1.0, 0.5, Vec3(0.04), 1.0}, 45.0, 0.5},
    {"satin metal, grazing", {Vec3(0.9, 0.6, 0.3), 1.0, 0.3, Vec3(0.04), 1.0}, 88.0, 1.0},
    {"smooth metal", {Vec3(0.9, 0.6, 0.3), 1.0, 0.0, Vec3(0.04), 1.0}, 60.0, 2e-3},
    {"half metal", {Vec3(0.9, 0.6, 0.3), 0.5, 0.6, Vec3(0.04), 0.5}, 50.0, 1.0},
};

struct Sampled {
    BsdfCase c;
    double pSpecular;
    std::vector<glm::vec4> samples; // direction, density
};

constexpr uint32_t kSamples = 1u << 20;

Sampled drawSamples(const SamplingCase& s, const std::vector<Specialisation>& faults = {}) {
    const BsdfCase c = test::bsdfCase(s.material, std::cos(s.degrees / 180.0 * reference::kPi));
    test::KernelHarness kernel(kernels::bsdf_sample, faults);
    const Buffer inputs = test::caseBuffer({c});
    const gpu::BsdfHarnessParams params{kSamples, 0, 11, 0};
    const auto records = kernel.run({inputs, test::reflectanceTable()}, params, kSamples, kSamples);
    Sampled result{c, test::evaluateBsdf({c}, {c.view})[0].pSpecular, {}};
    for (const glm::uvec4& record : records) result.samples.push_back(test::toFloats(record));
    return result;
}

// p-value of the samples against a density; directions below the horizon are expected to be what it lacks
// to 1.
double pValue(const SamplingCase& s, const Sampled& sampled, double pdfScale = 1.0) {
    const Vec3 v(sampled.c.view);
    const Vec3 mirror(-v.x, -v.y, v.z);
    reference::SphereHistogram histogram(s.histogramScale < 1.0 ? mirror : Vec3(0, 0, 1), s.histogramScale);
    for (const glm::vec4& sample : sampled.samples) {
        if (sample.w > 0.0f)
            histogram.add(glm::normalize(Vec3(sample)));
        else
            histogram.addRejected();
    }
    return histogram
        .test([&](const Vec3& l) { return pdfScale * expectedPdf(sampled.c, l, sampled.pSpecular); })
        .pValue;
}

const double kLevel = reference::sidakLevel(0.01, std::size(kSamplingCases));

} // namespace

TEST_CASE("f cos and density equal the double-precision twin") {
    const Sweep sweep = randomSweep(20000);
    CHECK(countWrong(sweep, test::evaluateBsdf(sweep.cases, sweep.directions)) == 0);
    const auto faulty = [&](uint32_t fault) {
        return countWrong(
            sweep, test::evaluateBsdf(sweep.cases, sweep.directions, {test::floatConstant(fault, 1.01f)}));
    };
    CHECK(faulty(test::kRadianceFault) > 19000);
    CHECK(faulty(test::kPdfFault) > 19000);
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("f(v, l) = f(l, v)") {
    const Sweep sweep = randomSweep(20000);
    Sweep swapped = sweep;
    for (size_t i = 0; i < sweep.cases.size(); ++i) std::swap(swapped.cases[i].view, swapped.directions[i]);
    const auto forth = test::evaluateBsdf(sweep.cases, sweep.directions);
    const auto back = test::evaluateBsdf(swapped.cases, swapped.directions);
    for (size_t i = 0; i < forth.size(); ++i) {
        const Vec3 v(sweep.cases[i].view), l(sweep.directions[i]);
        const Vec3 a = Vec3(forth[i].fCos) / l.z, b = Vec3(back[i].fCos) / v.z;
        INFO("case " << i << ": " << a.x << " and " << b.x);
        // V and L are unit vectors but for rounding, so V.H and L.H differ by a rounding over |V + L|.
        const double tolerance = rounding() * (64.0 + 16.0 / glm::length(v + l));
        REQUIRE(reference::maxComponent(glm::abs(a - b)) <= tolerance * reference::maxComponent(a));
    }
}

TEST_CASE("samples follow the density, and as many of them count as it integrates to") {
    for (const SamplingCase& s : kSamplingCases) {
        const Sampled sampled = drawSamples(s);
        const double p = pValue(s, sampled);
        INFO(s.name << ": p = " << p);
        CHECK(p > kLevel);
        for (size_t i = 0; i < sampled.samples.size(); i += 1009) {
            const glm::vec3 l(sampled.samples[i]);
            const double expected = expectedPdf(sampled.c, Vec3(l), sampled.pSpecular);
            REQUIRE(std::abs(sampled.samples[i].w - expected) <= lobeTolerance(sampled.c, l) * expected);
        }
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("a sampler or density that is off by 5 % is found") {
    const SamplingCase& metal = kSamplingCases[8];
    const SamplingCase& dielectric = kSamplingCases[3];
    CHECK(pValue(metal, drawSamples(metal, {test::floatConstant(test::kAlphaFault, 1.05f)})) < 1e-6);
    CHECK(pValue(dielectric, drawSamples(dielectric, {test::floatConstant(test::kLobeFault, 1.05f)})) < 1e-6);
    CHECK(pValue(metal, drawSamples(metal), 1.05) < 1e-6);
}
