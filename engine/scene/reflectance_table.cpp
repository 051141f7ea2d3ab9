#include "engine/scene/reflectance_table.h"

#include "shared/scene.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace irradia {

namespace {

using std::numbers::pi;

double schlickWeight(double cosine) {
    return std::pow(std::clamp(1.0 - cosine, 0.0, 1.0), 5.0);
}

// Smith's G2 / G1(v) = (v.z + root_v) l.z / (v.z root_l + l.z root_v), Heitz 2014.
double smithRoot(double c, double alpha) {
    return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * c * c);
}

// A and B by the midpoint rule over the square that the visible-normal warp (Dupuy and Benyoub 2023) maps to
// the lobe: the integrand there is Fc G2 / G1, smooth but for the horizon. By symmetry half the azimuths
// suffice.
glm::dvec2 integrateSpecular(double mu, double alpha) {
    constexpr int kRings = 96, kAzimuths = 24;
    const glm::dvec3 v(std::sqrt(std::max(1.0 - mu * mu, 0.0)), 0.0, mu);
    const glm::dvec3 s = glm::normalize(glm::dvec3(alpha * v.x, 0.0, v.z));
    const double rootV = smithRoot(v.z, alpha);
    glm::dvec2 sum(0.0);
    for (int i = 0; i < kRings; ++i) {
        const double z = (1.0 - (i + 0.5) / kRings) * (1.0 + s.z) - s.z;
        const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
        for (int j = 0; j < kAzimuths; ++j) {
            const double phi = pi * (j + 0.5) / kAzimuths;
            const glm::dvec3 c = glm::dvec3(r * std::cos(phi), r * std::sin(phi), z) + s;
            const glm::dvec3 h = glm::normalize(glm::dvec3(alpha * c.x, alpha * c.y, c.z));
            const double vh = glm::dot(v, h);
            const double lz = 2.0 * vh * h.z - v.z;
            if (lz <= 0.0) continue;
            const double weight = (v.z + rootV) * lz / (v.z * smithRoot(lz, alpha) + lz * rootV);
            const double fc = schlickWeight(vh);
            sum += glm::dvec2(1.0 - fc, fc) * weight;
        }
    }
    return sum / double(kRings * kAzimuths);
}

// C over a cosine-weighted hemisphere.
double integrateDiffuse(double mu) {
    constexpr int kRings = 64, kAzimuths = 32;
    const glm::dvec3 v(std::sqrt(std::max(1.0 - mu * mu, 0.0)), 0.0, mu);
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i) {
        const double u = (i + 0.5) / kRings;
        for (int j = 0; j < kAzimuths; ++j) {
            const double phi = pi * (j + 0.5) / kAzimuths;
            const glm::dvec3 l(std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi),
                               std::sqrt(1.0 - u));
            sum += schlickWeight(glm::dot(v, glm::normalize(v + l)));
        }
    }
    return sum / double(kRings * kAzimuths);
}

} // namespace

std::vector<glm::vec4> buildReflectanceTable() {
    std::vector<glm::vec4> table(gpu::kTableCosines * gpu::kTableRoughnesses);
    for (uint32_t i = 0; i < gpu::kTableCosines; ++i) {
        const double x = double(i) / (gpu::kTableCosines - 1);
        const double mu = std::max(x * x, 1e-6);
        const double diffuse = integrateDiffuse(mu);
        for (uint32_t j = 0; j < gpu::kTableRoughnesses; ++j) {
            const double roughness = double(j) / (gpu::kTableRoughnesses - 1);
            const glm::dvec2 specular =
                integrateSpecular(mu, std::max(roughness * roughness, double(gpu::kMinAlpha)));
            table[j * gpu::kTableCosines + i] = glm::vec4(specular.x, specular.y, diffuse, 0.0);
        }
    }
    return table;
}

} // namespace irradia
