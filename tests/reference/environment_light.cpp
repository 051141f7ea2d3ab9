#include "tests/reference/environment_light.h"
#include <algorithm>

namespace irradia::reference {

namespace {

// (u, v) in [0, 1]^2 of a direction.
Vec2 toPicture(const Vec3& d) {
    return {std::atan2(d.z, d.x) / (2.0 * kPi) + 0.5, std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi};
}

} // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : environment_(&environment) {
    if (environment.texels.empty()) {
        power_ = luminance(environment.constant);
        return;
    }
    std::vector<double> rowWeights;
    for (int y = 0; y < environment.height; ++y) {
        std::vector<double> weights(environment.width);
        for (int x = 0; x < environment.width; ++x) weights[x] = texelWeight(x, y);
        columns_.emplace_back(weights);
        rowWeights.push_back(columns_.back().total() * std::sin(kPi * (y + 0.5) / environment.height));
    }
    rows_ = DiscreteDistribution(rowWeights);
    power_ = rows_.total();
}

Vec3 EnvironmentLight::texel(int x, int y) const {
    const int column = (x + environment_->width) % environment_->width;
    const int row = std::clamp(y, 0, environment_->height - 1);
    return Vec3(environment_->texels[static_cast<size_t>(row) * environment_->width + column]);
}

// Mean luminance of the bilinear picture over the texel's square: positive wherever the picture is.
double EnvironmentLight::texelWeight(int x, int y) const {
    constexpr double kShare[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            sum += kShare[dx + 1] * kShare[dy + 1] * luminance(texel(x + dx, y + dy));
    return sum;
}

Vec3 EnvironmentLight::radiance(const Vec3& direction) const {
    if (environment_->texels.empty()) return Vec3(environment_->constant);
    const Vec2 uv = toPicture(direction);
    const double x = uv.x * environment_->width - 0.5, y = uv.y * environment_->height - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return (1.0 - fy) * ((1.0 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0)) +
           fy * ((1.0 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1));
}

Vec3 EnvironmentLight::sample(const Vec2& u) const {
    if (environment_->texels.empty()) {
        const Vec3 d = direction(1.0 - 2.0 * u.y, 2.0 * kPi * u.x);
        return {d.x, d.z, d.y};
    }
    const auto [row, withinRow] = rows_.sample(u.y);
    const auto [column, withinColumn] = columns_[row].sample(u.x);
    const double azimuth =
        2.0 * kPi * ((static_cast<double>(column) + withinColumn) / environment_->width - 0.5);
    const double polar = kPi * (static_cast<double>(row) + withinRow) / environment_->height;
    return {std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)};
}

double EnvironmentLight::pdf(const Vec3& direction) const {
    if (environment_->texels.empty()) return 0.25 / kPi;
    const Vec2 uv = toPicture(direction);
    const int column = std::clamp(static_cast<int>(uv.x * environment_->width), 0, environment_->width - 1);
    const int row = std::clamp(static_cast<int>(uv.y * environment_->height), 0, environment_->height - 1);
    const double density = rows_.probability(row) * columns_[row].probability(column) * environment_->width *
                           environment_->height; // over the unit square
    const double sinPolar = std::sqrt(std::fmax(0.0, 1.0 - direction.y * direction.y));
    return sinPolar > 0.0 ? density / (2.0 * kPi * kPi * sinPolar) : 0.0;
}

} // namespace irradia::reference
