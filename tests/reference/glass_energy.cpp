#include "tests/reference/glass_energy.h"
#include "tests/reference/energy_mend.h"
#include "tests/reference/interface_integrals.h"
#include "tests/reference/lagrange.h"
#include "tests/reference/parallel.h"
#include <map>

namespace irradia::reference {

namespace {

const double kLogMinAlpha = std::log(1e-3); // of the first row

double alphaOfRow(int row, int rows) {
    return std::exp(kLogMinAlpha * (1.0 - row / (rows - 1.0)));
}

} // namespace

GlassEnergy::GlassEnergy(double eta)
    : eta_(eta)
    , rows_(std::make_unique<std::array<Row, kAlphas>>()) {}

const GlassEnergy& GlassEnergy::ofInterface(double eta) {
    static std::mutex mutex;
    static std::map<double, std::unique_ptr<GlassEnergy>> all;
    const std::lock_guard lock(mutex);
    auto& energy = all[eta];
    if (!energy) energy = std::make_unique<GlassEnergy>(eta);
    return *energy;
}

const GlassEnergy& GlassEnergy::ofSheet() {
    static const GlassEnergy sheet(0.0);
    return sheet;
}

double GlassEnergy::exactAlbedo(double mu, double alpha) const {
    if (eta_ == 0.0) {
        const SpecularIntegrals integrals = integrateSpecular(mu, alpha);
        return integrals.a + integrals.b;
    }
    const InterfaceAlbedo albedo = integrateInterface(mu, alpha, {Vec3(normalReflectance(eta_)), 1.0, eta_});
    return albedo.reflected.x + albedo.transmitted;
}

// E goes like mu log(mu) at 0 (cube root), bends where mu is about alpha (logarithm) and, on the dense side,
// within about alpha of the critical angle (arsinh).
double GlassEnergy::warp(double mu, double alpha) const {
    const double grazing = std::cbrt(std::log1p(mu / alpha) / std::log1p(1.0 / alpha));
    if (eta_ == 0.0 || eta_ >= 1.0) return 0.6 * grazing + 0.4 * mu;
    const double critical = std::sqrt(1.0 - eta_ * eta_), width = 0.5 * alpha;
    const double start = std::asinh(critical / width), end = std::asinh((1.0 - critical) / width);
    const double nearCritical = (std::asinh((mu - critical) / width) + start) / (start + end);
    return 0.35 * grazing + 0.4 * nearCritical + 0.25 * mu;
}

double GlassEnergy::unwarp(double column, double alpha) const {
    double lower = 0.0, upper = 1.0;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (lower + upper);
        (warp(middle, alpha) < column ? lower : upper) = middle;
    }
    return upper;
}

void GlassEnergy::fill(Row& row, double alpha) const {
    std::array<double, kCosines> cosines;
    parallelFor(kCosines, 0, [&](int j) {
        cosines[j] = unwarp(j / (kCosines - 1.0), alpha);
        row.albedo[j] = exactAlbedo(cosines[j], alpha);
    });
    cosines.front() = 0.0, cosines.back() = 1.0;
    static const QuadratureRule rule = gaussLegendre(4);
    for (int j = 1; j < kCosines; ++j)
        row.average += rule.integrate(cosines[j - 1], cosines[j], [&](double mu) {
            return 2.0 * mu * Stencil(warp(mu, alpha) * (kCosines - 1), kCosines)(row.albedo);
        });
}

const GlassEnergy::Row& GlassEnergy::row(int index) const {
    Row& row = (*rows_)[index];
    std::call_once(row.once, [&] { fill(row, alphaOfRow(index, kAlphas)); });
    return row;
}

double GlassEnergy::albedo(double mu, double alpha) const {
    const Stencil rows((1.0 - std::log(alpha) / kLogMinAlpha) * (kAlphas - 1), kAlphas);
    const Stencil columns(warp(mu, alpha) * (kCosines - 1), kCosines);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += rows.weight[i] * columns(row(rows.first + i).albedo);
    return std::min(sum, 1.0); // nearly 1 where the surface is all but smooth
}

double GlassEnergy::average(double alpha) const {
    const Stencil rows((1.0 - std::log(alpha) / kLogMinAlpha) * (kAlphas - 1), kAlphas);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += rows.weight[i] * row(rows.first + i).average;
    return sum;
}

} // namespace irradia::reference
