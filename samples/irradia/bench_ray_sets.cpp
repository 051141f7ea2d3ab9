#include "bench_ray_sets.h"
#include <algorithm>
#include <cmath>
#include <random>

namespace irradia {
namespace {

// mt19937's own bits, so that the rays are the same with every standard library.
class Random {
public:
    float uniform() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; } // [0, 1)

private:
    std::mt19937 engine_{1};
};

std::vector<BenchRay> primaryRays(const Camera& camera, glm::uvec2 size, Random& random) {
    const bool parallel = camera.isOrthographic();
    const float scale = parallel ? camera.halfHeight : std::tan(0.5f * camera.verticalFov);
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    std::vector<BenchRay> rays;
    for (uint32_t y = 0; y < size.y; ++y)
        for (uint32_t x = 0; x < size.x; ++x) {
            const float px = (static_cast<float>(x) + random.uniform()) / static_cast<float>(size.x);
            const float py = (static_cast<float>(y) + random.uniform()) / static_cast<float>(size.y);
            const glm::vec3 across = (2 * px - 1) * scale * aspect * right + (1 - 2 * py) * scale * camera.up;
            if (parallel)
                rays.push_back({camera.position + across, camera.forward});
            else
                rays.push_back({camera.position, glm::normalize(camera.forward + across)});
        }
    return rays;
}

// Cosine-distributed about a unit normal: a point on the unit sphere about its tip.
glm::vec3 cosineDirection(const glm::vec3& normal, Random& random) {
    const float z = 1 - 2 * random.uniform();
    const float phi = 6.28318531f * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    const glm::vec3 sum = normal + 0.999f * glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
    return glm::normalize(sum);
}

// Points to light shadow rays from: on emissive triangles in proportion to area, else anywhere in the bounds.
class LightPoints {
public:
    explicit LightPoints(const Scene& scene)
        : scene_(scene)
        , bounds_(sceneBounds(scene)) {
        for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
            if (scene.materials[scene.triangles[i].material].emission == glm::vec3(0.0f)) continue;
            const auto [p0, e1, e2] = triangle(i);
            const float before = areas_.empty() ? 0.0f : areas_.back();
            areas_.push_back(before + glm::length(glm::cross(e1, e2)));
            emitters_.push_back(i);
        }
    }

    glm::vec3 sample(Random& random) const {
        const glm::vec3 r(random.uniform(), random.uniform(), random.uniform());
        if (emitters_.empty()) return glm::mix(bounds_.lower, bounds_.upper, r);
        const auto at = std::upper_bound(areas_.begin(), areas_.end(), r.x * areas_.back()) - areas_.begin();
        const auto [p0, e1, e2] =
            triangle(emitters_[std::min(static_cast<size_t>(at), emitters_.size() - 1)]);
        const float root = std::sqrt(r.y);
        return p0 + root * (1 - r.z) * e1 + root * r.z * e2;
    }

private:
    struct Edges {
        glm::vec3 p0, e1, e2;
    };
    Edges triangle(uint32_t index) const {
        const glm::uvec3 v = scene_.triangles[index].vertex;
        const glm::vec3 p0 = scene_.vertices[v.x].position;
        return {p0, scene_.vertices[v.y].position - p0, scene_.vertices[v.z].position - p0};
    }

    const Scene& scene_;
    Bounds bounds_;
    std::vector<uint32_t> emitters_;
    std::vector<float> areas_; // summed
};

// A point along a ray, moved off the surface there by a few roundings of what it is computed from.
glm::vec3 leave(const BenchRay& ray, float t, const glm::vec3& normal) {
    const glm::vec3 point = ray.origin + t * ray.direction, size = glm::abs(ray.origin) + glm::abs(point);
    return point + 0x1p-21f * (std::max({size.x, size.y, size.z}) + t) * normal;
}

} // namespace

BenchRaySets makeRaySets(const Scene& scene, const Camera& camera, glm::uvec2 size,
                         const EmbreeScene& embree) {
    Random random;
    BenchRaySets sets;
    sets.primary = primaryRays(camera, size, random);
    const LightPoints lights(scene);
    for (const BenchRay& ray : sets.primary) {
        const EmbreeHit hit = embree.closest(ray);
        if (hit.primitive == ~0u) continue;
        glm::vec3 normal = glm::normalize(hit.normal);
        if (glm::dot(normal, ray.direction) > 0.0f) normal = -normal;
        const glm::vec3 origin = leave(ray, hit.t, normal);
        sets.bounce.push_back({origin, cosineDirection(normal, random)});
        const glm::vec3 toLight = lights.sample(random) - origin;
        const float distance = glm::length(toLight);
        if (distance > 0.0f) sets.shadow.push_back({origin, toLight / distance, 0.9999f * distance});
    }
    return sets;
}

} // namespace irradia
