#include "tests/reference/sphere_histogram.h"
#include "tests/reference/quadrature.h"
#include <algorithm>
#include <numeric>

namespace irradia::reference {

namespace {

using Integrand = std::function<double(double, double)>;

struct Cell {
    double x0, x1, y0, y1;

    double integrate(const Integrand& f, const QuadratureRule& rule) const {
        return rule.integrate(
            x0, x1, [&](double x) { return rule.integrate(y0, y1, [&](double y) { return f(x, y); }); });
    }
};

// Splits the cell in four until the sum agrees with the whole; at least kMinLevel and at most kMaxLevel
// times. The last level bounds the work along a density's edge.
double integrateAdaptively(const Integrand& f, const Cell& cell, double whole, double tolerance, int level) {
    static const QuadratureRule rule = gaussLegendre(5);
    constexpr int kMinLevel = 1, kMaxLevel = 7;
    const double xm = 0.5 * (cell.x0 + cell.x1), ym = 0.5 * (cell.y0 + cell.y1);
    const Cell parts[4] = {{cell.x0, xm, cell.y0, ym},
                           {xm, cell.x1, cell.y0, ym},
                           {cell.x0, xm, ym, cell.y1},
                           {xm, cell.x1, ym, cell.y1}};
    double values[4], sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += values[i] = parts[i].integrate(f, rule);
    if (level >= kMaxLevel || (level >= kMinLevel && std::abs(sum - whole) < tolerance)) return sum;
    sum = 0.0;
    for (int i = 0; i < 4; ++i)
        sum += integrateAdaptively(f, parts[i], values[i], 0.5 * tolerance, level + 1);
    return sum;
}

} // namespace

SphereHistogram::SphereHistogram(const Vec3& axis, double scale, int polarBins, int azimuthBins)
    : frame_(axis)
    , scale_(scale)
    , polarBins_(polarBins)
    , azimuthBins_(azimuthBins)
    , counts_(static_cast<std::size_t>(polarBins) * azimuthBins + 1) {}

void SphereHistogram::add(const Vec3& direction) {
    const Vec3 d = frame_.toLocal(direction);
    const double sine = std::hypot(d.x, d.y); // tan(theta / 2) = sine / (1 + cosine), x = t / (1 + t)
    const double x = sine / (sine + scale_ * (1.0 + d.z));
    const double y = std::atan2(d.y, d.x) / (2.0 * kPi) + 0.5;
    const int i = std::clamp(static_cast<int>(x * polarBins_), 0, polarBins_ - 1);
    const int j = std::clamp(static_cast<int>(y * azimuthBins_), 0, azimuthBins_ - 1);
    counts_[static_cast<std::size_t>(i) * azimuthBins_ + j] += 1.0;
}

void SphereHistogram::addRejected() {
    counts_.back() += 1.0;
}

std::vector<double> SphereHistogram::integrals(const std::function<double(const Vec3&)>& pdf) const {
    const Integrand integrand = [&](double x, double y) {
        const double half = scale_ * x / (1.0 - x); // tan(theta / 2)
        const double square = half * half, cosine = (1.0 - square) / (1.0 + square),
                     sine = 2.0 * half / (1.0 + square);
        const double slope = 2.0 * scale_ / ((1.0 + square) * (1.0 - x) * (1.0 - x)); // d theta / d x
        const double azimuth = 2.0 * kPi * (y - 0.5);
        const Vec3 local(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
        return 2.0 * kPi * sine * slope * pdf(frame_.toWorld(local));
    };
    const double dx = 1.0 / polarBins_, dy = 1.0 / azimuthBins_;
    std::vector<double> result;
    for (int i = 0; i < polarBins_; ++i)
        for (int j = 0; j < azimuthBins_; ++j)
            result.push_back(
                integrateAdaptively(integrand, {i * dx, (i + 1) * dx, j * dy, (j + 1) * dy}, 0.0, 1e-7, 0));
    return result;
}

double SphereHistogram::integrate(const std::function<double(const Vec3&)>& pdf) const {
    const std::vector<double> bins = integrals(pdf);
    return std::accumulate(bins.begin(), bins.end(), 0.0);
}

ChiSquareResult SphereHistogram::test(const std::function<double(const Vec3&)>& pdf) const {
    const double samples = std::accumulate(counts_.begin(), counts_.end(), 0.0);
    std::vector<double> expected = integrals(pdf);
    const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
    expected.push_back(std::fmax(1.0 - total, 1e-7)); // the error of the quadrature
    for (double& e : expected) e *= samples;
    return chiSquareTest(counts_, expected);
}

} // namespace irradia::reference
