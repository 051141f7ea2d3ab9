// Glass of the shaders against its double-precision twin: values, reciprocity, densities and what is sampled;
// what smooth glass does by Snell and Fresnel; numbers at the ends of their ranges.
#include "kernels/shaders.h"
#include "tests/reference/glass.h"
#include "tests/reference/random.h"
#include "tests/reference/sphere_histogram.h"
#include "tests/support/bsdf_harness.h"
#include "tests/support/glass_harness.h"
#include "tests/support/gpu_rounding.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

using namespace irradia;
using reference::GlassLobes;
using reference::kPi;
using reference::Vec3;
using test::GlassCase;
using test::GlassEvaluation;

namespace {

double rounding() { // of one operation in single precision, relative
    return test::divisionSlack() * 0x1p-24;
}

// The twin of a case, and what a density is made of.
struct Twin {
    explicit Twin(const GlassCase& c)
        : surface{Vec3(c.base), c.metallic, c.roughness,
                  c.isSheet ? Vec3(c.f0) : reference::f0Between(Vec3(c.f0), c.ior, c.eta), c.specular}
        , parameters{kindOf(c), c.transmission, c.isSheet ? 1.0 : double(c.eta)}
        , glass(surface, parameters)
        , fresnel{surface.f0, c.specular, parameters.eta}
        , v(c.view)
        , ggx{glass.alpha()} {}

    static reference::GlassParameters::Kind kindOf(const GlassCase& c) {
        using Kind = reference::GlassParameters::Kind;
        if (!c.isSheet) return Kind::Solid;
        return c.roughness * c.roughness > 1e-3f ? Kind::RoughSheet : Kind::ClearSheet;
    }
    bool isSolid() const { return parameters.kind == reference::GlassParameters::Kind::Solid; }
    Vec3 tint() const { return (1.0 - surface.metallic) * parameters.transmission * surface.baseColor; }

    // Of the facet that sends v to l: v + l, v + l' or v + eta l, whose direction is its normal's.
    Vec3 halfway(const Vec3& l) const {
        if (l.z > 0.0 || !isSolid()) return v + Vec3(l.x, l.y, std::abs(l.z));
        const Vec3 h = v + parameters.eta * l;
        return h.z > 0.0 ? h : -h;
    }
    // D, masked by v alone, over solid angle: the density of l if all of a facet's light went there.
    double facetDensity(const Vec3& l) const {
        const Vec3 sum = halfway(l), h = glm::normalize(sum);
        const double vh = glm::dot(v, h), visible = 2.0 * ggx.distribution(h) / (v.z + ggx.root(v.z));
        if (l.z > 0.0 || !isSolid()) return 0.25 * visible;
        const double lh = -glm::dot(l, h), eta = parameters.eta;
        return vh > 0.0 && lh > 0.0 ? visible * vh * lh * eta * eta / glm::dot(sum, sum) : 0.0;
    }
    // What a facet that v meets at a cosine reflects and transmits, in luminance.
    std::pair<double, double> shares(double vh, bool transmits) const {
        const Vec3 f = fresnel(vh), base = surface.baseColor;
        const Vec3 metal = base + (1.0 - base) * reference::schlickWeight(vh);
        const double reflected =
            reference::luminance((1.0 - surface.metallic) * f + surface.metallic * metal);
        return {reflected,
                transmits ? reference::luminance(tint()) * (1.0 - reference::maxComponent(f)) : 0.0};
    }

    reference::BsdfParameters surface;
    reference::GlassParameters parameters;
    reference::Glass glass;
    reference::DielectricFresnel fresnel;
    Vec3 v;
    reference::Ggx ggx;
};

// f cos with the mend and the multiple scattering that the kernel took from its tables (whose errors their
// own suites bound).
Vec3 expectedValue(const Twin& twin, const GlassEvaluation& gpu, const Vec3& l) {
    const auto lobe = [&](GlassLobes lobes) { return twin.glass.evaluate(twin.v, l, lobes); };
    const double mend = std::min(twin.glass.mend(twin.v.z), twin.glass.mend(std::abs(l.z)));
    Vec3 f = lobe(GlassLobes::Reflection) + lobe(GlassLobes::Transmission);
    if (mend > 0.0) f += lobe(GlassLobes::Lambert) * (gpu.mend / mend);
    const double share = (1.0 - twin.surface.metallic) * twin.parameters.transmission;
    f += double(gpu.multiple) * gpu.loss * (l.z > 0.0 ? Vec3(share) : twin.tint());
    return std::abs(l.z) * f;
}

// With the kernel's probabilities of the lobes: any choice of them is right.
double expectedPdf(const Twin& twin, const GlassEvaluation& gpu, const Vec3& l) {
    const bool returns = l.z > 0.0;
    const auto [reflected, transmitted] =
        twin.shares(glm::dot(twin.v, glm::normalize(twin.halfway(l))), gpu.transmits);
    const double reflects = transmitted > 0.0 ? reflected / (reflected + transmitted) : 1.0;
    const double mu = std::abs(l.z), a2 = 4.0 * twin.ggx.alpha * twin.ggx.alpha;
    double pdf = returns ? gpu.pDiffuse * mu / kPi : 0.0;
    pdf += gpu.pFacets * (returns ? reflects : 1.0 - reflects) * twin.facetDensity(l);
    return pdf + gpu.pMultiple * (returns ? gpu.pReturn : 1.0 - gpu.pReturn) * mu /
                     (kPi * (mu * mu + a2) * std::log1p(1.0 / a2));
}

// Error of a facet's cosine by rounding v and l: they turn h by about a rounding over |v + eta l|.
double turn(const Twin& twin, const Vec3& l) {
    return rounding() * 8.0 * (1.0 + twin.parameters.eta) / glm::length(twin.halfway(l));
}

// Error of Fresnel's term, whose slope is infinite at the critical angle.
double fresnelError(const Twin& twin, const Vec3& l) {
    const double vh = glm::dot(twin.v, glm::normalize(twin.halfway(l))), eta = twin.parameters.eta;
    const double delta = turn(twin, l) + 4.0 * rounding();
    if (eta >= 1.0) return 5.0 * delta;
    const double square = std::abs(1.0 - (1.0 - vh * vh) / (eta * eta)); // of the refracted cosine
    return 5.0 * std::min(delta * 2.0 / (eta * eta * std::max(std::sqrt(square), 1e-9)),
                          std::sqrt(2.0 * delta) / eta);
}

// ---- Twin --------------------------------------------------------------------------------------------

struct Sweep {
    std::vector<GlassCase> cases;
    std::vector<glm::vec3> directions;
};

constexpr double kIndices[] = {1.02, 1.1, 1.33, 1.5, 1.8, 2.4};

GlassCase randomGlass(reference::Random& random) {
    const auto uniform = [&] { return static_cast<float>(random.uniform()); };
    const auto color = [&] { return glm::vec3(uniform(), uniform(), uniform()); };
    GlassCase c;
    c.base = color();
    c.metallic = std::clamp(1.5f * uniform() - 0.75f, 0.0f, 1.0f);
    c.f0 = uniform() < 0.5f ? glm::vec3(0.04f) : color();
    c.specular = uniform() < 0.5f ? 1.0f : uniform();
    c.roughness = uniform() < 0.1f ? 0.0f : 0.05f + 0.95f * uniform();
    const double eta = kIndices[static_cast<size_t>(6.0 * random.uniform())];
    c.eta = static_cast<float>(random.uniform() < 0.5 ? eta : 1.0 / eta);
    c.ior = uniform() < 0.1f ? 1.0f : 1.0f + 1.5f * uniform();
    c.transmission = std::clamp(1.5f * uniform(), 0.0f, 1.0f);
    c.isSheet = uniform() < 0.25f;
    c.view = glm::vec3(reference::direction(0.01 + 0.99 * random.uniform(), 6.0 * random.uniform()));
    return c;
}

// Random materials, views and directions; half of the directions are drawn from facets, where f is large.
Sweep randomSweep(size_t count) {
    reference::Random random(7);
    Sweep sweep;
    while (sweep.cases.size() < count) {
        const GlassCase c = randomGlass(random);
        const Twin twin(c);
        Vec3 l = reference::direction(2.0 * random.uniform() - 1.0, 6.0 * random.uniform());
        if (sweep.cases.size() % 2 == 0) {
            const Vec3 h = twin.ggx.sampleVisibleNormal(twin.v, random.uniform2());
            const bool isTotal = twin.fresnel.isTotal(glm::dot(twin.v, h));
            l = reference::reflect(twin.v, h);
            if (random.uniform() < 0.6 && !isTotal)
                l = c.isSheet ? Vec3(l.x, l.y, -l.z) : reference::refract(twin.v, h, twin.parameters.eta);
        }
        l = glm::normalize(l);
        if (std::abs(l.z) < 0.01) continue;
        sweep.cases.push_back(c);
        sweep.directions.push_back(glm::vec3(l));
    }
    return sweep;
}

// Values that are off by more than their tolerance.
int countWrong(const Sweep& sweep, const std::vector<GlassEvaluation>& values) {
    int wrong = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const Twin twin(sweep.cases[i]);
        const Vec3 l(sweep.directions[i]);
        // A turn by delta changes D by at most 2 delta / alpha; all else is a few dozen roundings.
        const double tolerance = 64.0 * rounding() + 2.0 * turn(twin, l) / twin.ggx.alpha;
        const auto [reflected, transmitted] =
            twin.shares(glm::dot(twin.v, glm::normalize(twin.halfway(l))), values[i].transmits);
        const double density = twin.facetDensity(l), df = fresnelError(twin, l);
        const double dPdf = df * density / std::max(reflected + transmitted, df);
        const double eta2 = l.z > 0.0 ? 1.0 : twin.parameters.eta * twin.parameters.eta;
        const auto isOff = [&](double value, double expected, double slack) {
            return !(std::abs(value - expected) <= tolerance * expected + slack + 1e-12);
        };
        const Vec3 value = expectedValue(twin, values[i], l);
        bool off = isOff(values[i].pdf, expectedPdf(twin, values[i], l), dPdf);
        for (int k = 0; k < 3; ++k)
            off = off || isOff(values[i].fCos[k], value[k], df * (density / eta2 + std::abs(l.z)));
        wrong += off;
        if (off && wrong < 5)
            UNSCOPED_INFO(
                fmt::format("case {}: eta {} roughness {} v.z {} l.z {}: f cos {} and {}, pdf {} and {}", i,
                            twin.parameters.eta, twin.surface.roughness, twin.v.z, l.z, values[i].fCos.x,
                            value.x, values[i].pdf, expectedPdf(twin, values[i], l)));
    }
    return wrong;
}

// The same path seen from its other end; what is beyond the surface becomes this side.
Sweep reversed(const Sweep& sweep) {
    Sweep back = sweep;
    for (size_t i = 0; i < back.cases.size(); ++i) {
        glm::vec3 &v = back.cases[i].view, &l = back.directions[i];
        std::swap(v, l);
        if (v.z > 0.0f) continue;
        v.z = -v.z;
        l.z = -l.z;
        back.cases[i].eta = 1.0f / back.cases[i].eta;
    }
    return back;
}

// ---- Sampling ----------------------------------------------------------------------------------------

// Around which directions are counted; around the last two, those of their side.
enum class Axis { Normal, Mirror, Refracted };

struct SamplingCase {
    const char* name;
    double eta; // 0 = a sheet
    float roughness;
    double degrees; // of the view direction from the normal
    float transmission, metallic;
    Axis axis;
    double histogramScale; // angle that the bins resolve around the axis; 1 = bins of a hemisphere
};

const SamplingCase kSamplingCases[] = {
    {"rough glass", 1.5, 0.7f, 45.0, 1.0f, 0.0f, Axis::Normal, 1.0},
    {"rough glass from inside, beyond the critical angle", 1 / 1.5, 0.7f, 45.0, 1.0f, 0.0f, Axis::Normal,
     1.0},
    {"satin glass from inside", 1 / 1.5, 0.4f, 30.0, 1.0f, 0.0f, Axis::Normal, 1.0},
    {"glossy water, grazing", 1.33, 0.25f, 80.0, 1.0f, 0.0f, Axis::Refracted, 0.2},
    {"glossy glass", 1.5, 0.2f, 50.0, 1.0f, 0.0f, Axis::Refracted, 0.05},
    {"smooth glass", 1.5, 0.0f, 40.0, 1.0f, 0.0f, Axis::Refracted, 2e-3},
    {"smooth glass from inside", 1 / 1.5, 0.0f, 30.0, 1.0f, 0.0f, Axis::Refracted, 3e-3},
    {"rough diamond from inside", 1 / 2.4, 1.0f, 20.0, 1.0f, 0.0f, Axis::Normal, 1.0},
    {"nearly no boundary", 1.02, 0.5f, 30.0, 1.0f, 0.0f, Axis::Refracted, 0.01},
    {"half transmissive, part metal", 1.5, 0.5f, 60.0, 0.6f, 0.3f, Axis::Normal, 1.0},
    {"rough sheet", 0.0, 0.6f, 60.0, 1.0f, 0.0f, Axis::Normal, 1.0},
    {"half transmissive satin sheet", 0.0, 0.35f, 45.0, 0.5f, 0.0f, Axis::Normal, 1.0},
    {"clear sheet, what does not pass", 0.0, 0.0f, 50.0, 0.7f, 0.0f, Axis::Mirror, 2e-3},
};

GlassCase glassCase(const SamplingCase& s) {
    const double mu = std::cos(s.degrees / 180.0 * kPi);
    GlassCase c = s.eta > 0.0 ? test::whiteGlass(s.eta, s.roughness, mu) : test::whiteSheet(s.roughness, mu);
    c.base = {0.9f, 0.7f, 0.4f};
    c.transmission = s.transmission;
    c.metallic = s.metallic;
    return c;
}

constexpr uint32_t kSamples = 1u << 20;

// Directions and their densities.
std::vector<glm::vec4> drawSamples(const GlassCase& c, uint32_t count, test::KernelHarness& kernel) {
    const Buffer inputs = test::caseBuffer({c});
    const gpu::BsdfHarnessParams params{count, 0, 11, 0};
    std::vector<glm::vec4> samples;
    for (const glm::uvec4& record :
         kernel.run({inputs, test::reflectanceTable(), test::glassTable()}, params, count, count))
        samples.push_back(test::toFloats(record));
    return samples;
}

// p-value of samples against the density; rejected ones are expected to be what it lacks to 1.
double pValue(const SamplingCase& s, const std::vector<Specialisation>& faults = {}, double pdfScale = 1.0) {
    const GlassCase c = glassCase(s);
    const Twin twin(c);
    const Vec3 normal(0, 0, 1), v = twin.v;
    const Vec3 axis = s.axis == Axis::Normal   ? normal
                      : s.axis == Axis::Mirror ? reference::reflect(v, normal)
                                               : reference::refract(v, normal, twin.parameters.eta);
    const auto counts = [&](double z) { return s.axis == Axis::Normal || (z > 0.0) == (axis.z > 0.0); };
    reference::SphereHistogram histogram(axis, s.histogramScale);
    test::KernelHarness kernel(kernels::glass_sample, faults);
    for (const glm::vec4& sample : drawSamples(c, kSamples, kernel)) {
        if (sample.w > 0.0f && counts(sample.z))
            histogram.add(glm::normalize(Vec3(sample)));
        else
            histogram.addRejected();
    }
    const GlassEvaluation view = test::evaluateGlass({c}, {c.view})[0]; // for the probabilities of the lobes
    const auto pdf = [&](const Vec3& l) { return counts(l.z) ? pdfScale * expectedPdf(twin, view, l) : 0.0; };
    return histogram.test(pdf).pValue;
}

const double kLevel = reference::sidakLevel(0.01, std::size(kSamplingCases));

} // namespace

TEST_CASE("f cos and density of glass equal the double-precision twin") {
    const Sweep sweep = randomSweep(20000);
    CHECK(countWrong(sweep, test::evaluateGlass(sweep.cases, sweep.directions)) == 0);
    const auto faulty = [&](uint32_t fault) {
        return countWrong(
            sweep, test::evaluateGlass(sweep.cases, sweep.directions, {test::floatConstant(fault, 1.01f)}));
    };
    CHECK(faulty(test::kRadianceFault) > 15000);
    CHECK(faulty(test::kPdfFault) > 15000);
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("glass that does not transmit is an opaque surface") {
    Sweep sweep = randomSweep(20000);
    std::vector<test::BsdfCase> opaque;
    for (GlassCase& c : sweep.cases) {
        c.transmission = 0.0f;
        c.isSheet = true;
        const reference::BsdfParameters material{Vec3(c.base), c.metallic, c.roughness, Vec3(c.f0),
                                                 c.specular};
        opaque.push_back({material, c.view});
    }
    for (glm::vec3& l : sweep.directions) l.z = std::abs(l.z);
    const auto values = test::evaluateGlass(sweep.cases, sweep.directions);
    const auto expected = test::evaluateBsdf(opaque, sweep.directions);
    for (size_t i = 0; i < values.size(); ++i) {
        const Twin twin(sweep.cases[i]);
        const Vec3 l(sweep.directions[i]), f(expected[i].fCos);
        const double tolerance = 64.0 * rounding() + 2.0 * turn(twin, l) / twin.ggx.alpha;
        INFO("case " << i << ": " << values[i].fCos.x << " and " << f.x << ", pdf " << values[i].pdf
                     << " and " << expected[i].pdf);
        REQUIRE(reference::maxComponent(glm::abs(Vec3(values[i].fCos) - f)) <=
                tolerance * reference::maxComponent(f) + 1e-12);
        REQUIRE(std::abs(values[i].pdf - expected[i].pdf) <= tolerance * expected[i].pdf + 1e-12);
    }
}

TEST_CASE("light scattered many times is the twin's") {
    Sweep sweep;
    for (const double eta : {0.0, 1.5, 1 / 1.5, 2.4, 1 / 2.4})
        for (const double roughness : {0.3, 0.8})
            for (const double mu : {0.1, 0.5, 0.9})
                for (const double lz : {-0.9, -0.4, 0.2, 0.8}) {
                    sweep.cases.push_back(eta > 0.0 ? test::whiteGlass(eta, roughness, mu)
                                                    : test::whiteSheet(roughness, mu));
                    sweep.directions.push_back(glm::vec3(reference::direction(lz, 2.0)));
                }
    const auto values = test::evaluateGlass(sweep.cases, sweep.directions);
    for (size_t i = 0; i < values.size(); ++i) {
        const Twin twin(sweep.cases[i]);
        const Vec3 l(sweep.directions[i]);
        const double expected = twin.glass.evaluate(twin.v, l, GlassLobes::MultipleScattering).x;
        INFO("eta " << twin.parameters.eta << ", roughness " << twin.surface.roughness << ", v.z " << twin.v.z
                    << ", l.z " << l.z);
        // By the error of 1 - E (glass_energy_test), which is 0.002 to 0.7 here.
        CHECK(std::abs(double(values[i].multiple) * values[i].loss - expected) < 0.02 * expected + 1e-3);
    }
}

TEST_CASE("f(v, l) / n_v^2 = f(l, v) / n_l^2") {
    const Sweep sweep = randomSweep(20000);
    const Sweep back = reversed(sweep);
    const auto forth = test::evaluateGlass(sweep.cases, sweep.directions);
    const auto other = test::evaluateGlass(back.cases, back.directions);
    for (size_t i = 0; i < forth.size(); ++i) {
        const Twin twin(sweep.cases[i]);
        const Vec3 l(sweep.directions[i]);
        const double eta2 = l.z > 0.0 ? 1.0 : twin.parameters.eta * twin.parameters.eta;
        const Vec3 a = Vec3(forth[i].fCos) / std::abs(l.z) * eta2, b = Vec3(other[i].fCos) / twin.v.z;
        INFO("case " << i << ": " << a.x << " and " << b.x);
        const double tolerance = 64.0 * rounding() + 4.0 * turn(twin, l) / twin.ggx.alpha;
        const double slack = 2.0 * fresnelError(twin, l) * (twin.facetDensity(l) / std::abs(l.z) + 1.0);
        REQUIRE(reference::maxComponent(glm::abs(a - b)) <= tolerance * reference::maxComponent(a) + slack);
    }
}

TEST_CASE("lights without extent show in all of rough glass, and in the Lambert lobe alone of smooth glass") {
    const Sweep sweep = randomSweep(20000);
    const auto values = test::evaluateGlass(sweep.cases, sweep.directions);
    for (size_t i = 0; i < values.size(); ++i) {
        const Twin twin(sweep.cases[i]);
        const Vec3 l(sweep.directions[i]);
        if (twin.glass.alpha() > reference::kMinAlpha) {
            REQUIRE(values[i].punctual == values[i].fCos);
            continue;
        }
        const double mend = std::min(twin.glass.mend(twin.v.z), twin.glass.mend(std::abs(l.z)));
        Vec3 expected(0.0);
        if (mend > 0.0)
            expected =
                std::abs(l.z) * twin.glass.evaluate(twin.v, l, GlassLobes::Lambert) * (values[i].mend / mend);
        const double slack = fresnelError(twin, l) + 64.0 * rounding();
        REQUIRE(reference::maxComponent(glm::abs(Vec3(values[i].punctual) - expected)) <= slack);
    }
}

TEST_CASE("samples of glass follow the density, and as many of them count as it integrates to") {
    for (const SamplingCase& s : kSamplingCases) {
        const double p = pValue(s);
        INFO(s.name << ": p = " << p);
        CHECK(p > kLevel);
    }
    CHECK(test::validatedDevice().validationMessages() == 0);
}

TEST_CASE("a sampler or density of glass that is off by 5 % is found") {
    const SamplingCase& satin = kSamplingCases[2];
    const SamplingCase& mixed = kSamplingCases[9];
    CHECK(pValue(satin, {test::floatConstant(test::kAlphaFault, 1.05f)}) < 1e-6);
    CHECK(pValue(mixed, {test::floatConstant(test::kLobeFault, 1.05f)}) < 1e-6);
    CHECK(pValue(satin, {}, 1.05) < 1e-6);
}

TEST_CASE("smooth glass obeys Snell and Fresnel") {
    constexpr uint32_t kCount = 1u << 16;
    test::KernelHarness kernel(kernels::glass_sample);
    for (const double eta : {1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5, 1 / 2.4})
        for (const double degrees : {0.0, 15.0, 40.0, 50.0, 70.0}) {
            const GlassCase c = test::whiteGlass(eta, 0.0, std::cos(degrees / 180.0 * kPi));
            const Vec3 v(c.view), normal(0, 0, 1);
            const reference::DielectricFresnel fresnel{Vec3(c.f0), 1.0, eta};
            const double reflects = fresnel(v.z).x;
            const Vec3 mirror(-v.x, -v.y, v.z);
            const Vec3 refracted = fresnel.isTotal(v.z) ? mirror : reference::refract(v, normal, eta);
            double transmitted = 0.0, astray = 0.0;
            for (const glm::vec4& sample : drawSamples(c, kCount, kernel)) {
                const Vec3 l(sample);
                transmitted += l.z < 0.0;
                astray += glm::length(l - (l.z < 0.0 ? refracted : mirror)) > 0.05;
            }
            INFO("eta " << eta << ", " << degrees << " degrees: transmitted " << transmitted / kCount
                        << ", expected " << 1.0 - reflects << ", astray " << astray / kCount);
            CHECK(astray < 0.01 * kCount); // all but 1 % of facets lie within 10 alpha
            if (fresnel.isTotal(v.z))
                CHECK(transmitted < 1e-3 * kCount); // facets that lie less flat
            else
                CHECK(std::abs(transmitted / kCount - 1.0 + reflects) < 0.006); // three standard deviations
        }
}

TEST_CASE("numbers at the ends of their ranges give numbers, and no sample weighs much") {
    constexpr uint32_t kCount = 1u << 20;
    test::KernelHarness kernel(kernels::glass_extremes);
    const gpu::BsdfHarnessParams params{kCount, 0, 3, 0};
    const auto results = kernel.run({test::reflectanceTable(), test::glassTable()}, params, kCount, kCount);
    uint64_t wrong = 0;
    float heaviest = 0.0f;
    for (const glm::uvec4& result : results) {
        wrong += result.x;
        heaviest = std::max(heaviest, test::toFloats(result).y);
    }
    INFO("heaviest sample " << heaviest);
    CHECK(wrong == 0);
    CHECK(heaviest < 200.0f);
    CHECK(test::validatedDevice().validationMessages() == 0);
}
