#include "embree_scene.h"
#include "engine/error.h"
#include "engine/scene/bvh/embree.h"
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace irradia {

struct EmbreeScene::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
};

namespace {

RTCGeometry triangleMesh(RTCDevice device, const Scene& scene) {
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), scene.vertices.size()));
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), scene.triangles.size()));
    if (!positions || !indices) fail(ExitCode::OutOfMemory, "embree: no memory for {}", scene.name);
    for (const Vertex& vertex : scene.vertices) *positions++ = vertex.position;
    for (const Triangle& triangle : scene.triangles) *indices++ = triangle.vertex;
    rtcCommitGeometry(mesh);
    return mesh;
}

RTCRay toRtc(const BenchRay& ray) {
    RTCRay out{};
    out.org_x = ray.origin.x, out.org_y = ray.origin.y, out.org_z = ray.origin.z;
    out.dir_x = ray.direction.x, out.dir_y = ray.direction.y, out.dir_z = ray.direction.z;
    out.tfar = ray.tMax;
    out.mask = 0xffffffffu;
    return out;
}

} // namespace

EmbreeScene::EmbreeScene(const Scene& scene, uint32_t threads)
    : state_(std::make_unique<State>())
    , threads_(threads) {
    state_->device = rtcNewDevice(fmt::format("threads={}", threads).c_str());
    state_->scene = rtcNewScene(state_->device);
    rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = triangleMesh(state_->device, scene);
    rtcAttachGeometry(state_->scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(state_->scene);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(state_->scene);
    rtcReleaseDevice(state_->device);
}

EmbreeHit EmbreeScene::closest(const BenchRay& ray) const {
    RTCRayHit hit{};
    hit.ray = toRtc(ray);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embreeIntersect(state_->scene, hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {hit.ray.tfar, hit.hit.primID, {hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z}};
}

bool EmbreeScene::isOccluded(const BenchRay& ray) const {
    RTCRay shadow = toRtc(ray);
    embreeOccluded(state_->scene, shadow);
    return shadow.tfar < 0.0f;
}

double EmbreeScene::parallel(size_t count, const std::function<void(size_t begin, size_t end)>& work) const {
    constexpr size_t kRun = 256;
    std::atomic<size_t> next{0};
    const auto worker = [&] {
        for (size_t begin = next.fetch_add(kRun); begin < count; begin = next.fetch_add(kRun))
            work(begin, std::min(count, begin + kRun));
    };
    const auto start = std::chrono::steady_clock::now();
    {
        std::vector<std::jthread> helpers;
        for (uint32_t i = 1; i < threads_; ++i) helpers.emplace_back(worker);
        worker();
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace irradia
