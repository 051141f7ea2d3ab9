#include "tests/support/closed_surface.h"

#include <algorithm>
#include <map>

namespace irradia {

std::array<glm::vec3, 3> corners(const Scene& scene, const Triangle& triangle) {
    return {scene.vertices[triangle.vertex[0]].position, scene.vertices[triangle.vertex[1]].position,
            scene.vertices[triangle.vertex[2]].position};
}

size_t unmatchedEdges(const Scene& scene) {
    using Key = std::array<float, 3>;
    const auto less = [](glm::vec3 a, glm::vec3 b) { return Key{a.x, a.y, a.z} < Key{b.x, b.y, b.z}; };
    std::map<glm::vec3, int, decltype(less)> numbers(less);
    const auto number = [&](glm::vec3 p) {
        return numbers.try_emplace(p, static_cast<int>(numbers.size())).first->second;
    };
    std::map<std::pair<int, int>, int> balance;
    for (const Triangle& triangle : scene.triangles) {
        const std::array<glm::vec3, 3> p = corners(scene, triangle);
        for (size_t i = 0; i < 3; i++) {
            const int a = number(p[i]), b = number(p[(i + 1) % 3]);
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return static_cast<size_t>(
        std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

} // namespace irradia
