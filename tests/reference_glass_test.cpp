// The reference's glass BSDF: its sampler, and what holds for any interface between two media.
#include "tests/reference/glass_cases.h"
#include "tests/reference/random.h"
#include "tests/reference/sphere_histogram.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia::reference;
using Catch::Approx;
using Kind = GlassParameters::Kind;

namespace {

constexpr double kAlphaLevel = 0.01; // of each family of statistical tests together

Vec3 randomOnSphere(Random& random) {
    return direction(2.0 * random.uniform() - 1.0, 2.0 * kPi * random.uniform());
}

} // namespace

TEST_CASE("f(V, L) / n_v^2 = f(L, V) / n_l^2") {
    Random random(5);
    const auto turned = [](const Vec3& d) { return Vec3(d.x, d.y, -d.z); };
    int transmissions = 0;
    for (const Kind kind : {Kind::Solid, Kind::RoughSheet})
        for (const double eta : {1.0 / 2.4, 1.5})
            for (int i = 0; i < 4000; ++i) {
                const Glass here = mixed(kind, eta, 0.7), there = mixed(kind, 1.0 / eta, 0.7);
                Vec3 v = randomOnSphere(random);
                v.z = std::abs(v.z);
                const Vec3 l = randomOnSphere(random);
                const Vec3 forth = here.evaluate(v, l);
                const Vec3 back =
                    l.z > 0.0 ? here.evaluate(l, v) : there.evaluate(turned(l), turned(v)) / here.etendue(l);
                transmissions += l.z < 0.0 && here.evaluate(v, l, GlassLobes::Transmission).x > 0.0;
                REQUIRE(glm::length(forth - back) <= 1e-9 * glm::length(forth));
            }
    CHECK(transmissions > 1000);
}

TEST_CASE("directions through glass are sampled with the density that pdf() states") {
    constexpr int kSamples = 1000000;
    const std::vector<double> cosines = {0.95, 0.5};
    const double level = sidakLevel(kAlphaLevel, glasses().size() * cosines.size());
    uint64_t seed = 10;
    for (const Glass& glass : glasses())
        for (const double mu : cosines) {
            const Vec3 v = direction(mu, 0.4);
            SphereHistogram histogram(Vec3(0, 0, 1), 1.0);
            Random random(++seed);
            for (int i = 0; i < kSamples; ++i) {
                const double uLobe = random.uniform();
                const BsdfSample sample = glass.sample(v, uLobe, random.uniform2());
                sample.pdf > 0.0 ? histogram.add(sample.direction) : histogram.addRejected();
            }
            const auto pdf = [&](const Vec3& l) { return glass.pdf(v, l); };
            CAPTURE(int(glass.glass().kind), glass.glass().eta, mu);
            CHECK(histogram.test(pdf).pValue > level);
            // Planted faults: a density 5 % too high, and 5 % of the light on the wrong side of the plane x =
            // 0.2.
            CHECK(histogram.test([&](const Vec3& l) { return 1.05 * pdf(l); }).pValue < 1e-6);
            CHECK(histogram.test([&](const Vec3& l) { return (l.x > 0.2 ? 1.05 : 0.95) * pdf(l); }).pValue <
                  1e-6);
        }
}

TEST_CASE("a narrow refracted lobe is seen by a histogram around Snell's direction") {
    for (const double eta : {1.0 / 1.5, 1.5}) {
        const auto glass = [&](double index, double roughness) {
            return Glass({Vec3(1.0), 0.0, roughness, Vec3(0.04), 1.0}, {Kind::Solid, 1.0, index});
        };
        const Vec3 v = direction(0.8, 0.4), snell = refract(v, Vec3(0, 0, 1), eta);
        SphereHistogram histogram(snell, 0.01);
        Random random(9);
        for (int i = 0; i < 1000000; ++i) {
            const double uLobe = random.uniform();
            const BsdfSample sample = glass(eta, 0.1).sample(v, uLobe, random.uniform2());
            sample.pdf > 0.0 ? histogram.add(sample.direction) : histogram.addRejected();
        }
        const auto pValue = [&](const Glass& g) {
            return histogram.test([&](const Vec3& l) { return g.pdf(v, l); }).pValue;
        };
        CAPTURE(eta);
        CHECK(pValue(glass(eta, 0.1)) > 0.5 * kAlphaLevel);
        CHECK(pValue(glass(eta, 0.1025)) < 1e-6);      // alpha 5 % too large
        CHECK(pValue(glass(1.002 * eta, 0.1)) < 1e-6); // the index a little off
    }
}

TEST_CASE("smooth glass refracts by Snell's law and reflects by Schlick's in the thinner medium") {
    for (const double eta : {1.0 / 1.5, 1.5}) {
        const Glass glass = whiteSolid(eta, 0.0);
        for (const double mu : {0.2, 0.6, 0.8, 1.0}) {
            const Vec3 v = direction(mu, 0.4);
            const double sineThere = std::sqrt(1.0 - mu * mu) / eta;
            const bool isTotal = sineThere >= 1.0;
            const double cosThin = eta > 1.0 ? mu : std::sqrt(1.0 - sineThere * sineThere);
            const double share = isTotal ? 1.0 : 0.04 + 0.96 * std::pow(1.0 - cosThin, 5.0);
            Random random(3);
            double reflected = 0.0, farthest = 0.0;
            constexpr int kSamples = 20000;
            for (int i = 0; i < kSamples; ++i) {
                const double uLobe = random.uniform();
                const Vec3 l = glass.sample(v, uLobe, {0.3, 0.5}).direction; // a microfacet near the median
                if (l.z > 0.0)
                    reflected += 1.0 / kSamples;
                else
                    farthest = std::max(farthest, glm::length(Vec2(l) + Vec2(v) / eta));
            }
            CAPTURE(eta, mu);
            CHECK(std::abs(reflected - share) < 2.5 / std::sqrt(kSamples) + 0.01); // the tilt shifts F
            CHECK(farthest < 5.0 * kMinAlpha / std::min(1.0, eta));                // tilts of about alpha
        }
    }
    // The two ends of a refracted path reflect alike.
    const DielectricFresnel in{Vec3(0.04), 1.0, 1.5}, out{Vec3(0.04), 1.0, 1.0 / 1.5};
    const double cosIn = 0.35, cosOut = std::sqrt(1.0 - (1.0 - cosIn * cosIn) / 2.25);
    CHECK(in(cosIn).x == Approx(out(cosOut).x).epsilon(1e-12));
}

TEST_CASE("between media all but alike light goes straight on, however rough the surface") {
    const Glass glass = whiteSolid(1.0001, 0.6);
    const Vec3 v = direction(0.8, 0.4);
    Random random(4);
    int straight = 0;
    for (int i = 0; i < 1000; ++i) {
        const double uLobe = random.uniform();
        const Vec3 l = glass.sample(v, uLobe, random.uniform2()).direction;
        straight += glm::length(l + v) < 1e-3;
    }
    CHECK(straight > 900); // the rest is scattered many times
}

TEST_CASE("a sheet that transmits nothing is the opaque BSDF") {
    const BsdfParameters surface{{0.9, 0.6, 0.3}, 0.25, 0.5, {0.05, 0.04, 0.03}, 0.8};
    const Glass glass(surface, {Kind::RoughSheet, 0.0});
    const Bsdf bsdf(surface);
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        Vec3 v = randomOnSphere(random);
        v.z = std::abs(v.z);
        const Vec3 l = randomOnSphere(random);
        REQUIRE(glm::length(glass.evaluate(v, l) - bsdf.evaluate(v, l)) <= 1e-12);
    }
}
