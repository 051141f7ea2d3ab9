// The reference's BSDF: its integrals, its sampler and the properties the contract promises.
#include "tests/reference/bsdf.h"
#include "tests/reference/energy_mend.h"
#include "tests/reference/random.h"
#include "tests/reference/sphere_histogram.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia::reference;
using Catch::Approx;

namespace {

constexpr double kAlphaLevel = 0.01; // of each family of statistical tests together

BsdfParameters dielectric(double roughness, const Vec3& base = Vec3(1.0)) {
    return {base, 0.0, roughness, Vec3(0.04), 1.0};
}

std::vector<BsdfParameters> materials() {
    return {dielectric(1.0),
            dielectric(0.3, {0.8, 0.5, 0.1}),
            {{0.9, 0.6, 0.3}, 1.0, 0.5, Vec3(0.04), 1.0},
            {{0.9, 0.6, 0.3}, 0.5, 0.25, {0.2, 0.1, 0.05}, 0.7},
            {Vec3(0.5), 0.0, 1.0, Vec3(0.04), 0.0}}; // Lambert
}

// Mean and standard deviation of the mean of samples of f N.L / pdf.
struct SampledAlbedo {
    Vec3 mean{0.0}, sigma{0.0};
};

SampledAlbedo sampleAlbedo(const Bsdf& bsdf, double mu, int samples, uint64_t seed) {
    Random random(seed);
    const Vec3 v = direction(mu, 0.4);
    Vec3 sum(0.0), squares(0.0);
    for (int i = 0; i < samples; ++i) {
        const double uLobe = random.uniform();
        const Vec3 weight = bsdf.sample(v, uLobe, random.uniform2()).weight;
        sum += weight;
        squares += weight * weight;
    }
    const double n = samples;
    const Vec3 mean = sum / n;
    return {mean, glm::sqrt(glm::max(squares / n - mean * mean, Vec3(0.0)) / n)};
}

Vec3 randomDirection(Random& random) {
    return direction(random.uniform(), 2.0 * kPi * random.uniform());
}

} // namespace

TEST_CASE("Gauss-Legendre is exact for polynomials of degree 2 n - 1") {
    for (const int n : {1, 2, 5, 16, 40}) {
        const double degree = 2.0 * n - 1.0;
        const double integral =
            gaussLegendre(n).integrate(0.0, 2.0, [&](double x) { return std::pow(x, degree); });
        CHECK(integral == Approx(std::pow(2.0, degree + 1.0) / (degree + 1.0)).epsilon(1e-12));
    }
}

TEST_CASE("the energy integrals converge and their table follows them") {
    const EnergyTable& table = EnergyTable::instance();
    Random random(1);
    double quadrature = 0.0, interpolation = 0.0, diffuse = 0.0;
    for (int i = 0; i < 400; ++i) {
        const double alpha = std::pow(kMinAlpha, random.uniform());
        double mu = random.uniform();
        if (i % 2 == 0)
            mu = std::min(1.0, alpha * std::expm1(std::log1p(1.0 / alpha) * mu)); // grazing ones too
        const SpecularIntegrals fine = integrateSpecular(mu, alpha, {64, 96});
        const SpecularIntegrals coarse = integrateSpecular(mu, alpha), read = table.specular(mu, alpha);
        quadrature = std::max({quadrature, std::abs(coarse.a - fine.a), std::abs(coarse.b - fine.b)});
        interpolation = std::max({interpolation, std::abs(read.a - fine.a), std::abs(read.b - fine.b)});
        if (i < 50) diffuse = std::max(diffuse, std::abs(table.diffuse(mu) - integrateDiffuse(mu)));
    }
    CHECK(quadrature < 1e-6);
    CHECK(interpolation < 1e-5);
    CHECK(diffuse < 1e-8);
}

TEST_CASE("the energy integrals are those of GGX sampled") {
    constexpr int kSamples = 200000;
    Random random(2);
    for (const double alpha : {0.01, 0.1, 0.5, 1.0})
        for (const double mu : {0.003, 0.05, 0.3, 0.9}) {
            const Vec3 v = direction(mu, 1.0);
            const Ggx ggx{alpha};
            double a = 0.0, b = 0.0;
            for (int i = 0; i < kSamples; ++i) {
                const Vec3 h = ggx.sampleVisibleNormal(v, random.uniform2()), l = reflect(v, h);
                if (l.z <= 0.0) continue;
                const double fc = schlickWeight(glm::dot(v, h)),
                             weight = ggx.maskingRatio(v.z, l.z) / kSamples;
                a += (1.0 - fc) * weight;
                b += fc * weight;
            }
            const SpecularIntegrals exact = integrateSpecular(mu, alpha);
            CAPTURE(alpha, mu);
            // A weight lies in [0, 1], so its deviation is at most 1/2: five of them.
            CHECK(std::abs(a - exact.a) < 2.5 / std::sqrt(kSamples));
            CHECK(std::abs(b - exact.b) < 2.5 / std::sqrt(kSamples));
        }
}

TEST_CASE("C is the Lambert integral of Schlick's weight") {
    Random random(4);
    for (const double mu : {0.0, 0.2, 0.7, 1.0}) {
        constexpr int kSamples = 200000;
        const Vec3 v = direction(mu, 0.0);
        double sum = 0.0;
        for (int i = 0; i < kSamples; ++i) {
            const Vec2 u = random.uniform2();
            const Vec3 l = direction(std::sqrt(u.x), 2.0 * kPi * u.y);
            sum += schlickWeight(glm::dot(v, glm::normalize(v + l)));
        }
        CHECK(std::abs(sum / kSamples - integrateDiffuse(mu)) < 5.0 * 0.1 / std::sqrt(kSamples));
    }
}

TEST_CASE("f(V, L) = f(L, V)") {
    Random random(5);
    for (const BsdfParameters& p : materials()) {
        const Bsdf bsdf(p);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 v = randomDirection(random), l = randomDirection(random);
            const Vec3 forth = bsdf.evaluate(v, l), back = bsdf.evaluate(l, v);
            CHECK(glm::length(forth - back) <= 1e-9 * glm::length(forth));
            CHECK(forth.x >= 0.0);
        }
    }
}

TEST_CASE("directions are sampled with the density that pdf() states") {
    constexpr int kSamples = 1000000;
    const std::vector<double> cosines = {0.95, 0.5, 0.1};
    const double level = sidakLevel(kAlphaLevel, materials().size() * cosines.size());
    uint64_t seed = 10;
    for (const BsdfParameters& p : materials())
        for (const double mu : cosines) {
            const Bsdf bsdf(p);
            const Vec3 v = direction(mu, 0.4);
            SphereHistogram histogram(Vec3(0, 0, 1), 1.0);
            Random random(++seed);
            for (int i = 0; i < kSamples; ++i) {
                const double uLobe = random.uniform();
                const BsdfSample sample = bsdf.sample(v, uLobe, random.uniform2());
                sample.pdf > 0.0 ? histogram.add(sample.direction) : histogram.addRejected();
            }
            const auto pdf = [&](const Vec3& l) { return bsdf.pdf(v, l); };
            CAPTURE(p.roughness, p.metallic, mu);
            CHECK(histogram.test(pdf).pValue > level);
            // Planted faults: a density 5 % too high, and one 5 % too high on one side and too low on the
            // other.
            CHECK(histogram.test([&](const Vec3& l) { return 1.05 * pdf(l); }).pValue < 1e-6);
            CHECK(histogram.test([&](const Vec3& l) { return (l.x > 0.2 ? 1.05 : 0.95) * pdf(l); }).pValue <
                  1e-6);
        }
}

TEST_CASE("a narrow lobe is seen by a histogram around the mirror direction") {
    const Bsdf bsdf({{0.9, 0.6, 0.3}, 1.0, 0.1, Vec3(0.04), 1.0}); // metal, alpha = 0.01
    const Vec3 v = direction(0.6, 0.0), mirror(-v.x, -v.y, v.z);
    SphereHistogram histogram(mirror, 0.02);
    Random random(6);
    for (int i = 0; i < 1000000; ++i) {
        const BsdfSample sample = bsdf.sample(v, 0.0, random.uniform2());
        sample.pdf > 0.0 ? histogram.add(sample.direction) : histogram.addRejected();
    }
    CHECK(histogram.test([&](const Vec3& l) { return bsdf.pdf(v, l); }).pValue > kAlphaLevel);
    const Bsdf wider({{0.9, 0.6, 0.3}, 1.0, 0.1025, Vec3(0.04), 1.0}); // alpha 5 % too large
    CHECK(histogram.test([&](const Vec3& l) { return wider.pdf(v, l); }).pValue < 1e-6);
}

TEST_CASE("pdf() integrates to 1 where no reflection is rejected") {
    for (const double mu : {1.0, 0.5}) {
        const Vec3 v = direction(mu, 0.4);
        const Bsdf lambert({Vec3(0.5), 0.0, 1.0, Vec3(0.04), 0.0}), smooth(dielectric(0.2));
        SphereHistogram sphere(Vec3(0, 0, 1), 1.0), peak(direction(mu, 0.4 + kPi), 0.05);
        CHECK(sphere.integrate([&](const Vec3& l) { return lambert.pdf(v, l); }) ==
              Approx(1.0).epsilon(1e-5));
        CHECK(peak.integrate([&](const Vec3& l) { return smooth.pdf(v, l); }) == Approx(1.0).epsilon(1e-3));
    }
}

TEST_CASE("directional albedo by sampling equals quadrature") {
    uint64_t seed = 100;
    for (const BsdfParameters& p : materials())
        for (const double mu : {0.02, 0.2, 0.6, 1.0}) {
            const Vec3 exact = directionalAlbedo(p, mu);
            const SampledAlbedo sampled = sampleAlbedo(Bsdf(p), mu, 200000, ++seed);
            CAPTURE(p.roughness, p.metallic, mu);
            for (int c = 0; c < 3; ++c)
                CHECK(std::abs(sampled.mean[c] - exact[c]) <
                      4.5 * sampled.sigma[c] + 1e-5); // 60 tests, p < 1e-3
        }
}

TEST_CASE("no direction reflects more than it receives, the worst case being a white dielectric") {
    double largest = 0.0, smallest = 2.0;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j) {
            const double roughness = (i + 1) / 20.0, mu = std::cos(0.5 * kPi * (j + 0.5) / 20.0);
            const double albedo = directionalAlbedo(dielectric(roughness), mu).x;
            largest = std::max(largest, albedo);
            smallest = std::min(smallest, albedo);
        }
    CHECK(largest <= 1.0 + 1e-3);
    CHECK(smallest > 0.6);                   // and the mend takes no more than it must
    for (const double f0 : {0.04, 0.3, 1.0}) // at its edge: the smoothest and strongest dielectric, metal
        for (const double mu : {0.001, 0.01, 0.1, 0.5, 1.0}) {
            CHECK(directionalAlbedo({Vec3(1.0), 0.0, 0.0, Vec3(f0), 1.0}, mu).x <= 1.0 + 1e-4);
            CHECK(directionalAlbedo({Vec3(1.0), 1.0, 0.0, Vec3(f0), 1.0}, mu).x <= 1.0 + 1e-4);
        }
}

TEST_CASE("without the mend a smooth white dielectric reflects 1.77 at 88 degrees") {
    // The fact the mend exists for: Lambert weighted by 1 - F(V.H), with F at normal-incidence half vectors.
    const double mu = std::cos(88.0 / 180.0 * kPi);
    const SpecularIntegrals integrals = integrateSpecular(mu, kMinAlpha);
    const double unmended = 0.04 * integrals.a + integrals.b + 0.96 * (1.0 - integrateDiffuse(mu));
    CHECK(unmended == Approx(1.77).margin(0.01));
}
