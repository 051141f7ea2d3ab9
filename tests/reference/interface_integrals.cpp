#include "tests/reference/interface_integrals.h"
#include "tests/reference/quadrature.h"
#include <algorithm>
#include <vector>

namespace irradia::reference {

namespace {

struct Sums {
    Vec3 reflected{0.0};
    double transmitted = 0.0;

    Sums& operator+=(const Sums& other) {
        reflected += other.reflected, transmitted += other.transmitted;
        return *this;
    }
    friend Sums operator*(double factor, const Sums& s) {
        return {factor * s.reflected, factor * s.transmitted};
    }
};

// Over [from, to], nodes gathered at both ends: x = t^2 (3 - 2 t) makes square roots there smooth.
template <typename Function>
Sums integratePanel(int order, double from, double to, const Function& f) {
    const QuadratureRule& nodes = keptRule(order);
    Sums sum;
    for (size_t i = 0; i < nodes.nodes.size(); ++i) {
        const double t = nodes.nodes[i], x = t * t * (3.0 - 2.0 * t);
        sum += nodes.weights[i] * 6.0 * t * (1.0 - t) * (to - from) * f(from + (to - from) * x);
    }
    return sum;
}

// From panel to panel between the sorted points.
template <typename Function>
Sums integratePanels(int order, std::vector<double> points, const Function& f) {
    std::sort(points.begin(), points.end());
    Sums sum;
    for (size_t i = 1; i < points.size(); ++i)
        if (points[i] - points[i - 1] > 1e-14) sum += integratePanel(order, points[i - 1], points[i], f);
    return sum;
}

// With tan(polar of H) = alpha sinh(y): D dH = sinh(y) / (pi cosh(y)^3 cos(polar)) dy dphi. The integrand
// bends where R or T cross the horizon, where V.H = 0 and at the critical angle: panels end there.
class InterfaceIntegral {
public:
    InterfaceIntegral(double mu, double alpha, const DielectricFresnel& fresnel, int order)
        : ggx_{alpha}
        , fresnel_(fresnel)
        , mu_(mu)
        , sinV_(std::sqrt(1.0 - mu * mu))
        , critical_(fresnel.eta < 1.0 ? std::sqrt(1.0 - fresnel.eta * fresnel.eta) : 0.0)
        , order_(order) {}

    // Over y. Where V and H lie in the plane of incidence the bends have explicit polar angles: those end
    // panels too, beside a few points that follow the decay of D.
    Sums integrate() const {
        const double polarV = std::acos(mu_), last = std::asinh(1e8);
        std::vector<double> points = {0.0, 0.8, 1.6, 2.8, 4.5, 8.0, last};
        const auto bendAt = [&](double polar) {
            if (polar > 0.0 && polar < 0.5 * kPi) points.push_back(heightOf(polar));
        };
        bendAt(0.25 * kPi - 0.5 * polarV); // R at the horizon
        bendAt(0.25 * kPi + 0.5 * polarV);
        bendAt(0.5 * kPi - polarV); // V.H = 0
        if (critical_ > 0.0) {
            const double angle = std::acos(critical_);
            for (const double polar : {polarV - angle, polarV + angle, angle - polarV}) bendAt(polar);
            for (const double side : {-1.0, 1.0}) // T at the horizon: H ~ V + eta (side, 0, 0)
                bendAt(std::atan2(std::abs(sinV_ + side * fresnel_.eta), mu_));
        }
        return integratePanels(order_, points, [&](double y) { return ring(y); });
    }

private:
    // y of a polar angle; what lies beyond tan = 1e8 alpha weighs < 1e-8.
    double heightOf(double polar) const { return std::asinh(std::fmin(std::tan(polar) / ggx_.alpha, 1e8)); }

    // The integral over the azimuth of H (even, hence twice the half), times the density in y.
    Sums ring(double y) const {
        const double tangent = ggx_.alpha * std::sinh(y), cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
        const double along = mu_ * cosine, across = sinV_ * tangent * cosine;
        std::vector<double> azimuths = {0.0, kPi};
        const auto bendAt = [&](double cosVH) {
            const double x = (cosVH - along) / across;
            if (across > 0.0 && x > -1.0 && x < 1.0) azimuths.push_back(std::acos(x));
        };
        bendAt(0.0);
        bendAt(0.5 * mu_ / cosine); // R at the horizon
        if (critical_ > 0.0) {
            bendAt(critical_);
            const double k = mu_ / cosine; // T at the horizon: c - sqrt(c^2 - critical^2) = k
            if (k > 0.0 && k < critical_) bendAt(0.5 * (k + critical_ * critical_ / k));
        }
        const Sums sum = integratePanels(order_, azimuths, [&](double azimuth) {
            return ofNormal(along + across * std::cos(azimuth), cosine);
        });
        const double cosh = std::cosh(y);
        return 2.0 * std::sinh(y) / (kPi * cosh * cosh * cosh * cosine) * sum;
    }

    // G2 / N.V with L at this cosine.
    double masking(double cosL) const { return 2.0 * cosL / (cosL * ggx_.root(mu_) + mu_ * ggx_.root(cosL)); }

    Sums ofNormal(double cosVH, double cosH) const {
        Sums sums;
        if (cosVH <= 0.0) return sums;
        const Vec3 f = fresnel_(cosVH);
        const double cosR = 2.0 * cosVH * cosH - mu_;
        if (cosR > 0.0) sums.reflected = cosVH * masking(cosR) * f;
        if (fresnel_.isTotal(cosVH)) return sums;
        const double eta = fresnel_.eta, cosT = std::sqrt(1.0 - (1.0 - cosVH * cosVH) / (eta * eta));
        const double below = mu_ / eta - (cosVH / eta - cosT) * cosH;
        if (below > 0.0) sums.transmitted = cosVH * masking(below) * (1.0 - maxComponent(f));
        return sums;
    }

    Ggx ggx_;
    DielectricFresnel fresnel_;
    double mu_, sinV_;
    double critical_; // cosine of the critical angle; 0 = there is none
    int order_;
};

} // namespace

InterfaceAlbedo integrateInterface(double mu, double alpha, const DielectricFresnel& fresnel, int order) {
    const Sums sums = InterfaceIntegral(mu, alpha, fresnel, order).integrate();
    return {sums.reflected, sums.transmitted};
}

} // namespace irradia::reference
