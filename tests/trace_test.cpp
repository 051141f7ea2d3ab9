// The tracing kernels on the device against brute force in double precision.
#include "engine/graph/frame_graph.h"
#include "engine/scene/bvh/bvh.h"
#include "kernels/path.h"
#include "shared/queue.h"
#include "shared/trace.h"
#include "tests/support/triangle_scenes.h"
#include "tests/support/validated_device.h"
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <limits>

using namespace irradia;
using namespace irradia::test;

using irradia::test::deviceWith;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr uint32_t kUntouched = 0xabcdabcdu;

struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};
    float tMax = 1e30f; // of a shadow ray
};

struct Hit {
    float t = 0;
    uint32_t primitive = 0;
    float u = 0, v = 0;
    bool operator==(const Hit&) const = default;
};

// A scene on a device, and the two kernels.
class Tracer {
public:
    explicit Tracer(const Scene& scene, QuadAccess records = QuadAccess::Texel)
        : device_(deviceWith(records))
        , bvh_(buildBvh(scene))
        , records_(makeBuffer(device_, "bvh", bvh_.quads))
        , closest_(device_, kernels::intersect_closest)
        , shadow_(device_, kernels::intersect_shadow) {}

    // One hit a ray; the slot after the last must stay untouched.
    std::vector<Hit> closest(const std::vector<Ray>& rays) {
        const std::vector<glm::uvec4> words = run<glm::uvec4>(closest_, rays);
        CHECK(words.back() == glm::uvec4(kUntouched));
        std::vector<Hit> hits;
        for (size_t i = 0; i < rays.size(); ++i)
            hits.push_back({std::bit_cast<float>(words[i].x), words[i].y, std::bit_cast<float>(words[i].z),
                            std::bit_cast<float>(words[i].w)});
        return hits;
    }

    // 1 = unoccluded.
    std::vector<uint32_t> visibility(const std::vector<Ray>& rays) {
        std::vector<uint32_t> words = run<uint32_t>(shadow_, rays);
        CHECK(words.back() == kUntouched);
        words.pop_back();
        return words;
    }

private:
    template <typename Word>
    std::vector<Word> run(const Kernel& kernel, const std::vector<Ray>& rays) {
        std::vector<glm::uvec4> queue;
        for (const Ray& ray : rays) {
            queue.push_back(std::bit_cast<glm::uvec4>(glm::vec4(ray.origin, ray.tMax)));
            queue.push_back(std::bit_cast<glm::uvec4>(glm::vec4(ray.direction, 0.0f)));
            queue.emplace_back(0u);
        }
        static_assert(gpu::kRayQuads == 3 && gpu::kShadowRayQuads == 3);
        const auto count = static_cast<uint32_t>(rays.size());
        std::vector<uint32_t> counters(gpu::kCounters, 12345u);
        counters[1] = count;
        const Buffer rayBuffer = makeBuffer(device_, "rays", queue);
        const Buffer counterBuffer = makeBuffer(device_, "counters", counters);
        const Buffer results(device_, "results", (rays.size() + 1) * sizeof(Word));
        FrameGraph graph(device_);
        graph.fill(results, kUntouched);
        graph.pass(kernel)
            .read(records_)
            .read(rayBuffer)
            .read(counterBuffer)
            .write(results)
            .push(gpu::TraceParams{1, bvh_.root, {}})
            .dispatch(count / gpu::kRaysPerLane + 2 * kernel.workgroupSize()); // idle groups do no harm
        graph.execute();
        CHECK(device_.validationMessages() == 0);
        return download<Word>(device_, results, rays.size() + 1);
    }

    Device& device_;
    Bvh bvh_;
    Buffer records_;
    Kernel closest_;
    Kernel shadow_;
};

// Moeller and Trumbore in double precision; `inside` is how far the hit lies inside the triangle, as the
// smallest barycentric: negative outside.
struct ExactHit {
    double t = 0;
    double inside = -1;
};

ExactHit intersect(const Corners& c, const Ray& ray) {
    const glm::dvec3 p0(c[0]), e1 = glm::dvec3(c[1]) - p0, e2 = glm::dvec3(c[2]) - p0, d(ray.direction);
    const glm::dvec3 p = glm::cross(d, e2), s = glm::dvec3(ray.origin) - p0, q = glm::cross(s, e1);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return {};
    const double u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant;
    return {glm::dot(e2, q) / determinant, std::min({u, v, 1 - u - v})};
}

// Floats may err by this much in barycentrics, the kernels' tolerance at edges included, and in t.
constexpr double kSlack = 4e-5;
constexpr double kDistanceSlack = 2e-5;

// A hit is right when its triangle is hit there (within slack) and none is hit clearly nearer.
uint32_t wrongHits(const Scene& scene, const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
    uint32_t wrong = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        double nearest = 1e30;
        for (uint32_t k = 0; k < scene.triangles.size(); ++k) {
            const ExactHit exact = intersect(corners(scene, k), rays[i]);
            if (exact.inside > kSlack && exact.t > kDistanceSlack) nearest = std::min(nearest, exact.t);
        }
        const double slack = kDistanceSlack * (1.0 + hits[i].t);
        if (hits[i].primitive == gpu::kNoPrimitive) {
            wrong += nearest < 1e30;
            continue;
        }
        const ExactHit own = intersect(corners(scene, hits[i].primitive), rays[i]);
        wrong += own.inside < -kSlack || std::abs(own.t - hits[i].t) > slack || hits[i].t > nearest + slack;
    }
    return wrong;
}

std::vector<Ray> randomRays(uint32_t count, uint32_t seed, float reach = 1.5f) {
    Random random(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) ray = {reach * random.inCube(), random.direction(), 2.0f * random.uniform()};
    return rays;
}

} // namespace

TEST_CASE("nearest hits agree with brute force") {
    const std::vector<Ray> rays = randomRays(3000, 1);
    for (const Scene& scene :
         {triangleSoup(300, 0.5f, 1), triangleSoup(40, 3.0f, 2), closedSphere(12, 20, 1.0f)}) {
        const std::vector<Hit> hits = Tracer(scene).closest(rays);
        CHECK(wrongHits(scene, rays, hits) == 0);
        std::vector<Hit> spoilt = hits; // the check must notice a fault of one part in a thousand
        for (Hit& hit : spoilt) hit.t *= 1.001f;
        CHECK(wrongHits(scene, rays, spoilt) > 500);
    }
}

TEST_CASE("axis-parallel rays meet axis-parallel triangles") {
    Scene box;
    for (int axis = 0; axis < 3; ++axis)
        for (float side : {-1.0f, 1.0f}) {
            glm::vec3 p[4];
            for (int k = 0; k < 4; ++k) {
                p[k][axis] = side;
                p[k][(axis + 1) % 3] = k & 1 ? 1.0f : -1.0f;
                p[k][(axis + 2) % 3] = k & 2 ? 1.0f : -1.0f;
            }
            add(box, {p[0], p[1], p[3]});
            add(box, {p[0], p[3], p[2]});
        }
    std::vector<Ray> rays;
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        glm::vec3 d(0.0f);
        d[i % 3] = i & 1 ? 1.0f : -1.0f;
        glm::vec3 o = 0.9f * random.inCube();
        if (i % 5 == 0) o[(i + 1) % 3] = o[(i + 2) % 3]; // on the diagonal two triangles share
        rays.push_back({o, d});
    }
    Tracer tracer(box);
    const std::vector<Hit> hits = tracer.closest(rays);
    CHECK(wrongHits(box, rays, hits) == 0);
    for (const Hit& hit : hits)
        if (hit.primitive == gpu::kNoPrimitive) FAIL("a ray left the box");
}

TEST_CASE("a closed sphere does not leak") {
    // From inside every ray hits, through the very edges and corners too, and where triangles are thin or
    // small.
    for (const Scene& sphere :
         {closedSphere(40, 64, 2.0f, {10, -3, 5}), closedSphere(250, 400, 2.0f, {10, -3, 5})}) {
        Random random(3);
        std::vector<Ray> rays;
        for (uint32_t i = 0; i < 100'000; ++i) {
            Ray ray{glm::vec3(10, -3, 5) + 1.1f * random.inCube(), random.direction(), 100.0f};
            const Corners c = corners(sphere, i % static_cast<uint32_t>(sphere.triangles.size()));
            const float along = i % 4 == 0 ? 0.0f : random.uniform();
            if (i % 2 == 0) ray.direction = glm::normalize(glm::mix(c[0], c[1], along) - ray.origin);
            rays.push_back(ray);
        }
        Tracer tracer(sphere);
        uint32_t leaks = 0;
        for (const Hit& hit : tracer.closest(rays)) leaks += hit.primitive == gpu::kNoPrimitive;
        CHECK(leaks == 0);
        for (uint32_t visible : tracer.visibility(rays)) leaks += visible;
        CHECK(leaks == 0);
    }
}

TEST_CASE("a sphere of millimetres does not leak beside triangles 100 km off, from within or from afar") {
    Scene scene = closedSphere(40, 64, 2e-3f);
    const Scene sphere = scene;
    for (const float side : {-1e5f, 1e5f})
        add(scene, {glm::vec3(side, 0, 0), glm::vec3(side, 1, 0), glm::vec3(side, 0, 1)});
    Random random(31);
    std::vector<Ray> within, afar;
    for (uint32_t i = 0; i < 50'000; ++i) {
        Ray ray{1e-3f * random.inCube(), random.direction(), 1.0f};
        const Corners c = corners(sphere, i % static_cast<uint32_t>(sphere.triangles.size()));
        if (i % 2 == 0) ray.direction = glm::normalize(glm::mix(c[0], c[1], random.uniform()) - ray.origin);
        within.push_back(ray);
        // Directions resolve 1 mm at 10 km; aim at the middle of the sphere.
        const glm::vec3 from = 1e3f * random.direction();
        afar.push_back({from, glm::normalize(1e-3f * random.direction() - from), 2e3f});
    }
    Tracer tracer(scene);
    for (const std::vector<Ray>& rays : {within, afar}) {
        uint32_t leaks = 0;
        for (const Hit& hit : tracer.closest(rays)) leaks += hit.primitive >= sphere.triangles.size();
        for (uint32_t visible : tracer.visibility(rays)) leaks += visible;
        CHECK(leaks == 0);
    }
}

TEST_CASE("a gap of 5 mm under a wall of 1 km stays open, and the wall closed") {
    Scene wall;
    const glm::vec3 p[4] = {{-1e3f, 0.005f, -1}, {1e3f, 0.005f, -1}, {1e3f, 1e3f, -1}, {-1e3f, 1e3f, -1}};
    add(wall, {p[0], p[1], p[2]});
    add(wall, {p[0], p[2], p[3]});
    Random random(32);
    std::vector<Ray> under, above;
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 from(900.0f * (2 * random.uniform() - 1), 0.0025f, 0);
        under.push_back({from, {0, 0, -1}, 10.0f});
        above.push_back({from + glm::vec3(0, 0.005f, 0), {0, 0, -1}, 10.0f});
    }
    Tracer tracer(wall);
    for (uint32_t visible : tracer.visibility(under)) REQUIRE(visible == 1u);
    for (uint32_t visible : tracer.visibility(above)) REQUIRE(visible == 0u);
}

TEST_CASE("any number of rays") {
    const Scene scene = triangleSoup(200, 0.6f, 4);
    Tracer tracer(scene);
    const std::vector<Ray> rays = randomRays(2051, 6);
    const std::vector<Hit> all = tracer.closest(rays);
    const std::vector<uint32_t> allVisible = tracer.visibility(rays);
    for (uint32_t count : {0u, 1u, 7u, 8u, 9u, 255u, 256u, 257u, 1023u, 1024u, 1025u, 2049u}) {
        const std::vector<Ray> some(rays.begin(), rays.begin() + count);
        CHECK(tracer.closest(some) == std::vector<Hit>(all.begin(), all.begin() + count));
        CHECK(tracer.visibility(some) ==
              std::vector<uint32_t>(allVisible.begin(), allVisible.begin() + count));
    }
}

TEST_CASE("shadow rays agree with nearest hits") {
    const Scene scene = triangleSoup(1000, 0.3f, 7);
    Tracer tracer(scene);
    const std::vector<Ray> rays = randomRays(20'000, 8);
    const std::vector<Hit> hits = tracer.closest(rays);
    const std::vector<uint32_t> visible = tracer.visibility(rays);
    uint32_t differing = 0;
    uint32_t occluded = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const bool blocked = hits[i].primitive != gpu::kNoPrimitive && hits[i].t < rays[i].tMax;
        differing += visible[i] != (blocked ? 0u : 1u);
        occluded += blocked;
    }
    CHECK(differing == 0);
    CHECK(occluded > 2000);
    CHECK(occluded < 18'000);
}

TEST_CASE("records in storage buffers give the same bits as texel views") {
    const Scene scene = triangleSoup(1000, 0.3f, 9);
    const std::vector<Ray> rays = randomRays(5000, 10);
    Tracer texel(scene, QuadAccess::Texel);
    Tracer storage(scene, QuadAccess::Storage);
    CHECK(texel.closest(rays) == storage.closest(rays));
    CHECK(texel.visibility(rays) == storage.visibility(rays));
}

TEST_CASE("rays that are none end as a miss") {
    std::vector<Ray> rays;
    for (float bad : {kNan, kInfinity, -kInfinity})
        for (int k = 0; k < 6; ++k) {
            Ray ray{glm::vec3(0.1f), glm::vec3(0, 0, 1)};
            (k < 3 ? ray.origin : ray.direction)[k % 3] = bad;
            rays.push_back(ray);
        }
    rays.push_back({glm::vec3(0.1f), glm::vec3(0.0f)});
    Tracer tracer(closedSphere(12, 20, 1.0f));
    for (const Hit& hit : tracer.closest(rays)) CHECK(hit.primitive == gpu::kNoPrimitive);
    for (uint32_t visible : tracer.visibility(rays)) CHECK(visible == 1u);
    // A shadow ray of no, negative or unknown length meets nothing.
    rays.clear();
    for (float tMax : {0.0f, -1.0f, kNan}) rays.push_back({glm::vec3(0.1f), glm::vec3(0, 0, 1), tMax});
    for (uint32_t visible : tracer.visibility(rays)) CHECK(visible == 1u);
}

TEST_CASE("nothing, one triangle, points and huge coordinates can be traced") {
    const std::vector<Ray> rays = randomRays(500, 11);
    for (const Hit& hit : Tracer(Scene{}).closest(rays)) REQUIRE(hit.primitive == gpu::kNoPrimitive);
    for (uint32_t visible : Tracer(Scene{}).visibility(rays)) REQUIRE(visible == 1u);
    const Scene one = triangleSoup(1, 2.0f, 12);
    CHECK(wrongHits(one, rays, Tracer(one).closest(rays)) == 0);
    Scene points;
    for (int i = 0; i < 300; ++i) add(points, {glm::vec3(0.5f), glm::vec3(0.5f), glm::vec3(0.5f)});
    for (const Hit& hit : Tracer(points).closest(rays)) REQUIRE(hit.primitive == gpu::kNoPrimitive);
    Tracer(triangleSoup(500, 0.3f, 13, 1e30f)).closest(rays); // must only end
    Tracer(triangleSoup(500, 0.3f, 14, 3e37f)).closest(rays);
}

TEST_CASE("equal triangles hide each other and lose no ray") {
    Scene stack;
    for (int i = 0; i < 2000; ++i)
        add(stack, {glm::vec3(-5, -5, 2), glm::vec3(5, -5, 2), glm::vec3(0, 8, 2)});
    std::vector<Ray> rays = randomRays(500, 15);
    for (Ray& ray : rays) ray.direction = glm::vec3(0, 0, 1), ray.tMax = 10.0f;
    Tracer tracer(stack);
    for (const Hit& hit : tracer.closest(rays)) REQUIRE(hit.primitive < 2000u);
    for (uint32_t visible : tracer.visibility(rays)) REQUIRE(visible == 0u);
}

// The CPU driver's vector width is fixed when it starts: the suite runs itself again at the other widths.
TEST_CASE("subgroups of 4 and 16 lanes", "[widths]") {
    if (!deviceWith(QuadAccess::Texel).isCpu()) SKIP("the subgroup size is the device's own");
    for (const char* bits : {"128", "512"}) {
        const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
        const std::string command =
            fmt::format("LP_NATIVE_VECTOR_WIDTH={} '{}' '~[widths]' >/dev/null", bits, self);
        INFO(command);
        CHECK(std::system(command.c_str()) == 0);
    }
}
