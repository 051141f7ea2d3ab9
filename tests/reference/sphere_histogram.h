// Histograms of directions and the integrals of a density over their bins: the two sides of a chi-square
// test. A direction at angle theta from the axis has x = t / (1 + t), t = tan(theta / 2) / scale; bins are
// uniform in x and azimuth. scale 1 around the normal puts the horizon on the edge between bins (an even
// number of them); a small scale around the mirror direction spreads a narrow lobe of about that angle over
// many bins.
#pragma once

#include "tests/reference/math.h"
#include "tests/reference/statistics.h"
#include <functional>

namespace irradia::reference {

class SphereHistogram {
public:
    SphereHistogram(const Vec3& axis, double scale, int polarBins = 16, int azimuthBins = 16);

    void add(const Vec3& direction); // unit
    void addRejected();              // a sample that gave no direction

    // Test of the samples added so far against pdf (per solid angle, any unit direction, >= 0) by adaptive
    // quadrature; rejected samples are expected to be what the density lacks to 1.
    ChiSquareResult test(const std::function<double(const Vec3&)>& pdf) const;

    // Integral of the density over the sphere.
    double integrate(const std::function<double(const Vec3&)>& pdf) const;

private:
    std::vector<double> integrals(const std::function<double(const Vec3&)>& pdf) const; // one for each bin

    Frame frame_;
    double scale_;
    int polarBins_, azimuthBins_;
    std::vector<double> counts_; // by bin, the rejected ones last
};

} // namespace irradia::reference
