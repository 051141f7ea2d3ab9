#include "engine/scene/scene_origin.h"

#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

constexpr double kNear = 32.0;

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

glm::dvec3 sceneOrigin(const std::vector<glm::dvec3>& points) {
    if (points.empty()) return glm::dvec3(0.0);
    std::vector<double> values(points.size());
    glm::dvec3 center;
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::transform(points, values.begin(), [&](const glm::dvec3& p) { return p[axis]; });
        center[axis] = median(values);
    }
    std::ranges::transform(points, values.begin(), [&](const glm::dvec3& p) {
        const glm::dvec3 distance = glm::abs(p - center);
        return std::max({distance.x, distance.y, distance.z});
    });
    const double spread = median(values);
    const double off = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    if (off <= kNear * spread) return glm::dvec3(0.0);
    if (!(spread > 0.0)) return center;
    const double step = std::ldexp(1.0, std::ilogb(spread));
    return step * glm::round(center / step);
}

} // namespace irradia
