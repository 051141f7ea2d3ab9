#include "engine/scene/reflectance_table.h"

#include "shared/scene.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace irradia {

namespace {

using std::numbers::pi;

double schlickWeight(double cosine) {
    const double m = std::clamp(1.0 - cosine, 0.0, 1.0);
    return m * m * m * m * m;
}

// The root in Smith's masking, G1 = 2 c / (c + root) (Heitz 2014).
double smithRoot(double c, double alpha) {
    return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * c * c);
}

struct Node {
    double x, weight;
};

// The midpoint rule on [0, 1] after the substitution u - sin(2 pi u) / (2 pi), which gathers nodes at both
// ends and makes it converge fast whatever the integrand does there (Sidi 1993, "A new variable
// transformation").
template <size_t N>
std::array<Node, N> sidiRule() {
    std::array<Node, N> nodes;
    for (size_t i = 0; i < N; ++i) {
        const double u = 2.0 * pi * (static_cast<double>(i) + 0.5) / static_cast<double>(N);
        nodes[i] = {(u - std::sin(u)) / (2.0 * pi), (1.0 - std::cos(u)) / static_cast<double>(N)};
    }
    return nodes;
}

// The integrals A and B over l, written over the half vector h: spec l.z dl = D h.z dh times
// 2 l.z v.h / (h.z (l.z root(v) + v.z root(l))). The polar angle of h is tan = alpha p / (1 - p).
class SpecularIntegral {
public:
    SpecularIntegral(double mu, double alpha)
        : mu_(mu)
        , alpha_(alpha)
        , sine_(std::sqrt(std::max(1.0 - mu * mu, 0.0)))
        , root_(smithRoot(mu, alpha)) {}

    // (A, B). l is above the horizon for every azimuth of h up to one polar angle and for none beyond
    // another.
    glm::dvec2 evaluate() const {
        static const auto kRule = sidiRule<24>();
        const double polar = std::acos(mu_);
        const double all = parameterOf(0.25 * pi - 0.5 * polar);
        const double none = parameterOf(0.25 * pi + 0.5 * polar);
        glm::dvec2 sum(0.0);
        for (const Node& node : kRule)
            sum +=
                node.weight * (all * ring(all * node.x) + (none - all) * ring(all + (none - all) * node.x));
        return sum;
    }

private:
    double parameterOf(double polar) const {
        const double t = std::tan(polar) / alpha_;
        return t / (1.0 + t);
    }

    // Mean over the azimuth at p, times the density of D h.z over p: 2 p (1 - p) / (p^2 + (1 - p)^2)^2.
    glm::dvec2 ring(double p) const {
        static const auto kRule = sidiRule<16>();
        const double q = 1.0 - p, norm = p * p + q * q;
        const double tangent = alpha_ * p / q;
        const double hz = 1.0 / std::sqrt(1.0 + tangent * tangent);
        const double across = sine_ * tangent * hz;
        const double bound = across > 0.0 ? (0.5 * mu_ / hz - mu_ * hz) / across : -1.0; // l.z > 0 above it
        const double last = std::acos(std::clamp(bound, -1.0, 1.0));
        glm::dvec2 sum(0.0);
        for (const Node& node : kRule) {
            const double vh = mu_ * hz + across * std::cos(last * node.x);
            const double lz = 2.0 * vh * hz - mu_;
            if (lz <= 0.0) continue;
            const double fc = schlickWeight(vh);
            const double value = 2.0 * lz * vh / (hz * (lz * root_ + mu_ * smithRoot(lz, alpha_)));
            sum += node.weight * value * glm::dvec2(1.0 - fc, fc);
        }
        return sum * (last / pi * 2.0 * p * q / (norm * norm));
    }

    double mu_, alpha_, sine_, root_;
};

// C over a cosine-weighted hemisphere.
double integrateDiffuse(double mu) {
    static const auto kRings = sidiRule<24>();
    static const auto kAzimuths = sidiRule<16>();
    const double sine = std::sqrt(std::max(1.0 - mu * mu, 0.0));
    double sum = 0.0;
    for (const Node& ring : kRings) {
        for (const Node& node : kAzimuths) {
            const double vl = sine * std::sqrt(ring.x) * std::cos(pi * node.x) + mu * std::sqrt(1.0 - ring.x);
            sum +=
                ring.weight * node.weight * schlickWeight(std::sqrt(std::max(0.5 * (1.0 + vl), 0.0))); // v.h
        }
    }
    return sum;
}

} // namespace

double reflectanceCosine(double column, double alpha) {
    const double a = gpu::kTableAlphaScale * alpha;
    double lower = 0.0, upper = 1.0;
    for (int i = 0; i < 50; ++i) { // bisection
        const double mu = 0.5 * (lower + upper);
        const double x = (2.0 * std::sqrt(mu) + std::sqrt(mu * (1.0 + a) / (mu + a))) / 3.0;
        (x < column ? lower : upper) = mu;
    }
    return upper;
}

double reflectanceAlpha(double row) {
    const double root = gpu::kTableFirstRoot + row * (1.0 - gpu::kTableFirstRoot);
    return std::max(std::pow(root, 4.0), double(gpu::kMinAlpha));
}

std::vector<glm::vec4> buildReflectanceTable() {
    std::vector<glm::vec4> table;
    table.reserve(gpu::kTableCosines * gpu::kTableRoughnesses);
    for (uint32_t j = 0; j < gpu::kTableRoughnesses; ++j) {
        const double alpha = reflectanceAlpha(double(j) / (gpu::kTableRoughnesses - 1));
        for (uint32_t i = 0; i < gpu::kTableCosines; ++i) {
            // At mu = 0 nothing is left of the lobe but its limit.
            const double mu = std::max(reflectanceCosine(double(i) / (gpu::kTableCosines - 1), alpha), 1e-6);
            const glm::dvec2 specular = SpecularIntegral(mu, alpha).evaluate();
            table.emplace_back(specular.x, specular.y, integrateDiffuse(mu), 0.0);
        }
    }
    return table;
}

} // namespace irradia
