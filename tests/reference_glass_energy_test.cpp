// The reference's glass: how much light its BSDF reflects and transmits.
#include "tests/reference/energy_mend.h"
#include "tests/reference/glass_albedo.h"
#include "tests/reference/glass_cases.h"
#include "tests/reference/interface_integrals.h"
#include "tests/reference/random.h"
#include "tests/reference/sphere_histogram.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia::reference;
using Catch::Approx;
using Kind = GlassParameters::Kind;

namespace {

constexpr double kEtas[] = {1.0 / 2.4, 1.0 / 1.5, 1.0 / 1.1, 1.0001, 1.33, 1.5, 2.4};

// Means of sampled weights, as shares of light, with their standard deviations.
struct SampledAlbedo {
    Vec3 reflected{0.0}, transmitted{0.0}, sigma{0.0}; // sigma: of both together
};

SampledAlbedo sampleAlbedo(const Glass& glass, double mu, int samples, uint64_t seed) {
    Random random(seed);
    const Vec3 v = direction(mu, 0.4);
    SampledAlbedo albedo;
    Vec3 squares(0.0);
    const double n = samples;
    for (int i = 0; i < samples; ++i) {
        const double uLobe = random.uniform();
        const BsdfSample sample = glass.sample(v, uLobe, random.uniform2());
        const Vec3 share = glass.etendue(sample.direction) * sample.weight;
        (sample.direction.z > 0.0 ? albedo.reflected : albedo.transmitted) += share / n;
        squares += share * share / n;
    }
    const Vec3 mean = albedo.reflected + albedo.transmitted;
    albedo.sigma = glm::sqrt(glm::max(squares - mean * mean, Vec3(0.0)) / n);
    return albedo;
}

double sum(const GlassAlbedo& albedo) {
    return albedo.reflected.x + albedo.transmitted.x;
}

} // namespace

TEST_CASE("an interface's integrals converge and their table follows them") {
    Random random(1);
    double quadrature = 0.0, interpolation = 0.0;
    for (const double eta : {1.0 / 2.4, 1.0 / 1.5, 1.0001, 1.5})
        for (int i = 0; i < 60; ++i) {
            const double alpha = std::pow(kMinAlpha, random.uniform());
            double mu = random.uniform(); // a third grazing, a third near the critical angle
            if (i % 3 == 0) mu = std::min(1.0, alpha * std::expm1(std::log1p(1.0 / alpha) * mu));
            if (i % 3 == 1 && eta < 1.0)
                mu = std::clamp(std::sqrt(1.0 - eta * eta) + alpha * (4.0 * mu - 2.0), 0.0, 1.0);
            const DielectricFresnel fresnel{Vec3(normalReflectance(eta)), 1.0, eta};
            const InterfaceAlbedo fine = integrateInterface(mu, alpha, fresnel, 30);
            const InterfaceAlbedo coarse = integrateInterface(mu, alpha, fresnel);
            quadrature = std::max({quadrature, std::abs(coarse.reflected.x - fine.reflected.x),
                                   std::abs(coarse.transmitted - fine.transmitted)});
            if (i >= 21) continue; // each makes rows of the table
            const double read = GlassEnergy::ofInterface(eta).albedo(mu, alpha);
            interpolation = std::max(interpolation, std::abs(read - fine.reflected.x - fine.transmitted));
        }
    CHECK(quadrature < 2e-6);
    CHECK(interpolation < 2e-5);
}

TEST_CASE("an interface's integrals are those of sampled microfacets") {
    constexpr int kSamples = 200000;
    Random random(2);
    for (const double eta : {1.0 / 1.5, 1.8})
        for (const double alpha : {0.02, 0.3, 1.0})
            for (const double mu : {0.02, 0.3, 0.72, 1.0}) {
                const Vec3 v = direction(mu, 1.0);
                const Ggx ggx{alpha};
                const DielectricFresnel fresnel{Vec3(normalReflectance(eta)), 1.0, eta};
                double reflected = 0.0, transmitted = 0.0;
                for (int i = 0; i < kSamples; ++i) {
                    const Vec3 h = ggx.sampleVisibleNormal(v, random.uniform2());
                    const double share = fresnel(glm::dot(v, h)).x;
                    const Vec3 r = reflect(v, h);
                    if (r.z > 0.0) reflected += share * ggx.maskingRatio(v.z, r.z) / kSamples;
                    if (fresnel.isTotal(glm::dot(v, h))) continue;
                    const Vec3 t = refract(v, h, eta);
                    if (t.z < 0.0) transmitted += (1.0 - share) * ggx.maskingRatio(v.z, -t.z) / kSamples;
                }
                const InterfaceAlbedo exact = integrateInterface(mu, alpha, fresnel);
                CAPTURE(eta, alpha, mu);
                // A weight lies in [0, 1], so its deviation is at most 1/2: five of them.
                CHECK(std::abs(reflected - exact.reflected.x) < 2.5 / std::sqrt(kSamples));
                CHECK(std::abs(transmitted - exact.transmitted) < 2.5 / std::sqrt(kSamples));
                // Where all is reflected, they are those of mirrors.
                const SpecularIntegrals mirrors = integrateSpecular(mu, alpha);
                const double all = integrateInterface(mu, alpha, {Vec3(1.0), 1.0, 1.5}).reflected.x;
                CHECK(std::abs(all - mirrors.a - mirrors.b) < 1e-6);
            }
}

TEST_CASE("white glass is white from both sides, at any roughness and index") {
    double worst = 0.0, leastWithout = 1.0;
    for (const double roughness : {0.05, 0.2, 0.5, 1.0})
        for (const double mu : {0.03, 0.2, 0.5, 0.74, 0.8, 1.0}) {
            worst = std::max(worst, std::abs(sum(directionalAlbedo(whiteSheet(roughness), mu)) - 1.0));
            for (const double eta : kEtas) {
                worst =
                    std::max(worst, std::abs(sum(directionalAlbedo(whiteSolid(eta, roughness), mu)) - 1.0));
                const double alpha = roughness * roughness;
                leastWithout = std::min(leastWithout, GlassEnergy::ofInterface(eta).albedo(mu, alpha));
            }
        }
    CHECK(worst < 1e-4);        // the table's error
    CHECK(leastWithout < 0.75); // what single scattering alone would keep: the test has power
    // The same by quadrature of the BSDF itself over the sphere.
    for (const Glass& glass : {whiteSolid(1.5, 0.7), whiteSolid(1.0 / 1.5, 0.7), whiteSheet(0.7)})
        for (const double mu : {0.3, 0.9}) {
            const Vec3 v = direction(mu, 0.4);
            const double total = SphereHistogram(Vec3(0, 0, 1), 1.0).integrate([&](const Vec3& l) {
                return glass.etendue(l) * glass.evaluate(v, l).x * std::abs(l.z);
            });
            CHECK(total == Approx(1.0).margin(1e-3)); // of the adaptive rule along the horizon
        }
}

TEST_CASE("directional albedo of glass by sampling equals quadrature") {
    uint64_t seed = 100;
    for (const Glass& glass : glasses())
        for (const double mu : {0.05, 0.4, 0.8, 1.0}) {
            const GlassAlbedo exact = directionalAlbedo(glass, mu);
            const SampledAlbedo sampled = sampleAlbedo(glass, mu, 200000, ++seed);
            CAPTURE(int(glass.glass().kind), glass.glass().eta, mu);
            for (int c = 0; c < 3; ++c) { // 28 x 9 tests of 4.5 sigma: p < 2e-3
                const double difference =
                    sampled.reflected[c] + sampled.transmitted[c] - exact.reflected[c] - exact.transmitted[c];
                CHECK(std::abs(difference) < 4.5 * sampled.sigma[c] + 1e-4);
                // The sides apart: weights spread by 1 or less, so this is five deviations or more.
                CHECK(std::abs(sampled.reflected[c] - exact.reflected[c]) < 5.0 / std::sqrt(200000));
            }
            CHECK(maxComponent(exact.reflected + exact.transmitted) < 1.0 + 1e-3);
        }
}

TEST_CASE("a white solid that transmits a part of the light never gives more than it gets") {
    double largest = 0.0;
    for (const double tau : {0.0, 0.5, 0.9})
        for (const double eta : {1.0 / 2.4, 1.0 / 1.5, 1.5})
            for (const double roughness : {0.03, 0.2, 0.6, 1.0})
                for (int i = 0; i < 16; ++i) {
                    const Glass glass({Vec3(1.0), 0.0, roughness, Vec3(normalReflectance(eta)), 1.0},
                                      {Kind::Solid, tau, eta});
                    largest = std::max(largest, sum(directionalAlbedo(glass, (i + 0.5) / 16.0)));
                }
    CAPTURE(largest);
    CHECK(largest < 1.0 + 1e-3);
    // Were the mend not that of the refracted direction, the Lambert lobe would add to total reflection.
    const Glass half({Vec3(1.0), 0.0, 0.0, Vec3(0.04), 1.0}, {Kind::Solid, 0.5, 1.0 / 1.5});
    CHECK(half.mend(0.7) == 0.0); // the critical angle is at cosine 0.745
    CHECK(half.mend(0.8) > 0.0);
}
