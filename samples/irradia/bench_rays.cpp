// irradia bench rays: the tracing kernels against Embree on the same rays, in interleaved rounds.
#include "bench_ray_sets.h"
#include "bench_tools.h"
#include "commands.h"
#include "engine/error.h"
#include "engine/graph/frame_graph.h"
#include "engine/log.h"
#include "engine/scene/bvh/bvh.h"
#include "engine/scene/load_scene.h"
#include "kernels/path.h"
#include "request_options.h"
#include "samples/session/kernel_form.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/outputs.h"
#include "samples/support/program.h"
#include "samples/support/standard_streams.h"
#include "shared/queue.h"
#include "shared/trace.h"
#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

struct BenchRaysOptions {
    std::string scene;
    std::string camera;
    std::string size = "256x256";
    uint32_t rounds = 15;
    std::string json;
    DeviceOptions device;
    std::string form = "auto";
};

// One set of rays in buffers, and the kernel that traces it.
class DeviceRays {
public:
    DeviceRays(Device& device, const Kernel& kernel, const Buffer& bvh, uint32_t root,
               const std::vector<BenchRay>& rays)
        : kernel_(kernel)
        , bvh_(bvh)
        , root_(root)
        , count_(static_cast<uint32_t>(rays.size()))
        , graph_(device)
        , rays_(makeBuffer(device, "rays", queue(rays)))
        , counters_(makeBuffer(device, "counters", std::vector<uint32_t>(gpu::kCounters, count_)))
        , results_(device, "results", std::max<uint64_t>(count_, 1) * sizeof(glm::uvec4)) {}

    // Seconds of one dispatch, submission included.
    double trace() {
        graph_.pass(kernel_)
            .read(bvh_)
            .read(rays_)
            .read(counters_)
            .write(results_)
            .push(gpu::TraceParams{0, root_, {}})
            .dispatch((count_ + gpu::kRaysPerLane - 1) / gpu::kRaysPerLane);
        const auto start = std::chrono::steady_clock::now();
        graph_.execute();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    template <typename Word>
    std::vector<Word> results(Device& device) const {
        return download<Word>(device, results_, count_);
    }

private:
    static std::vector<glm::uvec4> queue(const std::vector<BenchRay>& rays) {
        static_assert(gpu::kRayQuads == 3 && gpu::kShadowRayQuads == 3);
        std::vector<glm::uvec4> records;
        for (const BenchRay& ray : rays) {
            records.push_back(std::bit_cast<glm::uvec4>(glm::vec4(ray.origin, ray.tMax)));
            records.push_back(std::bit_cast<glm::uvec4>(glm::vec4(ray.direction, 0.0f)));
            records.emplace_back(0u);
        }
        return records;
    }

    const Kernel& kernel_;
    const Buffer& bvh_;
    uint32_t root_;
    uint32_t count_;
    FrameGraph graph_;
    Buffer rays_, counters_, results_;
};

// A kind of rays: what Embree and the device make of them, and the rounds' times.
struct RayKind {
    std::string name;
    const std::vector<BenchRay>& rays;
    bool shadow;
    DeviceRays device;
    std::vector<double> ratios = {}; // device speed over Embree's, by round
    std::vector<double> seconds = {};
    std::vector<double> embreeSeconds = {};
};

double embreeTime(const RayKind& kind, const EmbreeScene& embree) {
    std::atomic<size_t> hits{0}; // so that no call can be left out
    return embree.parallel(kind.rays.size(), [&](size_t begin, size_t end) {
        size_t found = 0;
        for (size_t i = begin; i < end; ++i)
            found +=
                kind.shadow ? embree.isOccluded(kind.rays[i]) : embree.closest(kind.rays[i]).primitive != ~0u;
        hits += found;
    });
}

// Rays on whose hit the two disagree: hit or miss, or distances that differ by more than 1e-4.
size_t mismatches(Device& device, const RayKind& kind, const EmbreeScene& embree) {
    size_t count = 0;
    if (kind.shadow) {
        const std::vector<uint32_t> visible = kind.device.results<uint32_t>(device);
        for (size_t i = 0; i < kind.rays.size(); ++i)
            count += (visible[i] == 0) != embree.isOccluded(kind.rays[i]);
        return count;
    }
    const std::vector<glm::uvec4> hits = kind.device.results<glm::uvec4>(device);
    for (size_t i = 0; i < kind.rays.size(); ++i) {
        const EmbreeHit expected = embree.closest(kind.rays[i]);
        const bool missed = hits[i].y == gpu::kNoPrimitive;
        const float t = std::bit_cast<float>(hits[i].x);
        if (missed || expected.primitive == ~0u)
            count += missed != (expected.primitive == ~0u);
        else
            count += std::abs(t - expected.t) > 1e-4f * expected.t;
    }
    return count;
}

std::string sceneFile(const BenchRaysOptions& options) {
    if (!options.scene.empty()) return options.scene;
    const auto program = std::filesystem::read_symlink("/proc/self/exe");
    const auto own = program.parent_path().parent_path() / "scenes" / "interior.glb";
    if (!std::filesystem::exists(own))
        fail(ExitCode::NotFound, "{}: not found; name a scene, or write the project's own with make_scenes",
             own.string());
    return own.string();
}

void report(const RayKind& kind, size_t wrong) {
    const double millions = static_cast<double>(kind.rays.size()) * 1e-6;
    printResult("{:8} {:8} rays  {:7.3f} Mrays/s  embree {:7.3f}  ratio {:.3f}  mismatches {}\n", kind.name,
                kind.rays.size(), millions / median(kind.seconds), millions / median(kind.embreeSeconds),
                median(kind.ratios), wrong);
}

nlohmann::ordered_json jsonOf(const std::vector<RayKind*>& kinds, const Device& device, size_t triangles) {
    nlohmann::ordered_json json;
    for (const RayKind* kind : kinds)
        json["rays"][kind->name] = {
            {"mrays", static_cast<double>(kind->rays.size()) * 1e-6 / median(kind->seconds)},
            {"embree_ratio", median(kind->ratios)}};
    json["device"] = device.description().name;
    json["triangles"] = triangles;
    return json;
}

void benchRays(BenchRaysOptions options) {
    const glm::uvec2 size = parseSize(options.size);
    options.device.quads = kernelForm(options.form).access;
    checkOutputs({{"--json", options.json}}, {{"the scene", options.scene}, {"the camera", options.camera}});
    catchInterrupts();
    const Scene scene = loadScene(sceneFile(options));
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh = buildBvh(scene);
    const double built = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Device device(options.device);
    const EmbreeScene embree(scene, cpuThreads(device));
    logLine("{}: {} triangles, built in {:.2f} s; {} against Embree on {} threads", scene.name,
            scene.triangles.size(), built, device.description().name, embree.threads());

    const BenchRaySets sets = makeRaySets(scene, chooseCamera(scene, options.camera).camera, size, embree);
    if (sets.bounce.empty()) fail(ExitCode::BadData, "{}: the camera sees nothing", scene.name);
    const Buffer records = makeBuffer(device, "bvh", bvh.quads);
    const Kernel closest(device, kernels::intersect_closest);
    const Kernel shadow(device, kernels::intersect_shadow);
    RayKind primary{"primary", sets.primary, false, {device, closest, records, bvh.root, sets.primary}};
    RayKind bounce{"bounce", sets.bounce, false, {device, closest, records, bvh.root, sets.bounce}};
    RayKind shadowed{"shadow", sets.shadow, true, {device, shadow, records, bvh.root, sets.shadow}};
    const std::vector<RayKind*> kinds{&primary, &bounce, &shadowed};

    // The first dispatch compiles the kernel and is not counted.
    for (RayKind* kind : kinds) kind->device.trace();
    stopIfInterrupted();
    uint32_t rounds = 0;
    for (; rounds < options.rounds && !interruptedBy(); ++rounds)
        for (RayKind* kind : kinds) {
            kind->embreeSeconds.push_back(embreeTime(*kind, embree));
            kind->seconds.push_back(kind->device.trace());
            kind->ratios.push_back(kind->embreeSeconds.back() / kind->seconds.back());
        }
    if (options.json != "-")
        for (const RayKind* kind : kinds) report(*kind, mismatches(device, *kind, embree));
    if (!options.json.empty()) writeJson(options.json, jsonOf(kinds, device, scene.triangles.size()));
    endIfInterrupted(rounds, "rounds");
}

} // namespace

void addBenchRays(CLI::App& bench) {
    auto options = std::make_shared<BenchRaysOptions>();
    CLI::App* command = bench.add_subcommand("rays", "The tracing kernels against Embree on the same rays");
    command->add_option("scene", options->scene, "glTF scene; the project's own interior if none");
    command->add_option("--camera", options->camera, "Camera by name, index or .json file");
    command->add_option("--size", options->size, "Primary rays, WxH")->capture_default_str();
    addWhole(*command, "--rounds", options->rounds, "Rounds, each tracing all rays on both; medians count", 1,
             10000)
        ->capture_default_str();
    addOutput(*command, "--json", options->json, "File for the numbers, - for stdout");
    command->add_option("--device", options->device.select, "Index, name, cpu or gpu")->group("Device");
    addSubgroup(*command, options->device.subgroupSize)->group("Device");
    addForm(*command, options->form, {"auto", "texel", "storage"},
            "Of the kernels, how they read queues: texel, storage or auto");
    command->callback([options] { benchRays(*options); });
}

} // namespace irradia
