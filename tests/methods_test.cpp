// What it takes to add a cache or a method: a class and a row of the methods' table each, which the session
// then renders like those of the project.
#include "engine/error.h"
#include "nrc/cache/cache_queries.h"
#include "nrc/cache/radiance_scale.h"
#include "nrc/renderer/nrc_methods.h"
#include "samples/session/render_session.h"
#include "tests/support/expect_error.h"
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using irradia::test::expectError;

// ---- a cache: the same radiance everywhere, from which nothing is learned ----

namespace {

class ConstantCache : public Cache {
public:
    ConstantCache(Device& device, const CacheRoom& room, float radiance)
        : radiance_(radiance)
        , queries_(device, room.queries)
        , predictions_(device, "predictions", queries_.weights().bytes())
        , state_(device)
        , paths_(device, "training paths", rows(room) * gpu::kTrainingPathBytes)
        , vertices_(device, "training vertices", rows(room) * gpu::kVertexBytes)
        , ends_(device, "training queries", rows(room) * gpu::kCacheInputBytes) {}

    CacheBuffers buffers() const override {
        return {queries_.inputs(), queries_.weights(), queries_.counters(), paths_, vertices_, ends_};
    }
    void begin(FrameGraph& graph) override { graph.fill(paths_, 0); }
    void beginQueries(FrameGraph& graph) override { queries_.begin(graph); }
    void answer(FrameGraph& graph, BufferRange radiance) override {
        graph.fill(predictions_, std::bit_cast<uint32_t>(radiance_));
        queries_.resolve(graph, predictions_, state_.state(), false, radiance);
    }
    void learn(FrameGraph& /*graph*/, uint32_t /*paths*/, const TrainingEffort& /*effort*/) override {}
    CacheCounts counts() const override { return {}; }

private:
    static uint64_t rows(const CacheRoom& room) { return paddedRows(room.trainingPaths); }

    float radiance_;
    CacheQueries queries_;
    Buffer predictions_;
    RadianceScale state_;
    Buffer paths_, vertices_, ends_;
};

Method constantCache(float radiance) {
    Method method;
    method.name = "constant";
    method.help = "a cache that says the same everywhere, at the first hit";
    method.hasCache = true;
    method.setup = [radiance](const MethodRequest& request) {
        NrcOptions options{request.paths, nrcPreset("fast"), request.seed, CacheKind{}};
        options.config.endDepth = 0;
        options.cache->planned = [](bool, const VkPhysicalDeviceLimits&, const CacheRoom& room) {
            return CacheQueries::planned(room.queries);
        };
        options.cache->make = [radiance](Device& device, const CacheRoom& room) {
            return std::make_unique<ConstantCache>(device, room, radiance);
        };
        return std::make_unique<NrcSetup>(options);
    };
    return method;
}

} // namespace

// ---- a method: pictures of one colour ----

namespace {

class FlatRenderer : public Renderer {
public:
    FlatRenderer(const PathTracerOptions& paths, float grey)
        : paths_(paths)
        , grey_(grey) {}

    void prepare(const std::function<bool(double share)>& goesOn) override {
        for (int step = 1; step <= 4 && goesOn(0.25 * step); ++step) ++prepared_;
    }
    void renderFrame(const Camera& /*camera*/, uint32_t /*index*/) override { ++frames_; }
    void forgetFilm() override { frames_ = 0; }
    FilmImage readFilm() const override {
        FilmImage film;
        film.width = static_cast<int>(paths_.width);
        film.height = static_cast<int>(paths_.height);
        film.frames = frames_;
        film.mean.assign(paths_.pixels(), glm::vec3(grey_));
        return film;
    }
    RendererStatistics statistics() const override { return {}; }
    std::map<std::string, std::string> attributes() const override {
        return {{"prepared", std::to_string(prepared_)}};
    }

private:
    PathTracerOptions paths_;
    float grey_;
    uint32_t frames_ = 0, prepared_ = 0;
};

class FlatSetup : public MethodSetup {
public:
    FlatSetup(const PathTracerOptions& paths, float grey)
        : MethodSetup(paths)
        , grey_(grey) {}
    std::vector<Device::PlannedBuffer> planned(bool, const VkPhysicalDeviceLimits&,
                                               const PathTracerOptions&) const override {
        return {};
    }
    std::unique_ptr<Renderer> make(const RendererPlace& /*place*/) const override {
        return std::make_unique<FlatRenderer>(paths(), grey_);
    }

private:
    float grey_;
};

Method flat() {
    Method method;
    method.name = "flat";
    method.help = "one grey";
    method.options = {{"grey", "Of every pixel", "0.5", "", false}};
    method.whyNot = [](const Scene& scene) { return scene.triangles.empty() ? "it is empty" : ""; };
    method.setup = [options = method.options](const MethodRequest& request) {
        return std::make_unique<FlatSetup>(request.paths, std::stof(valueOf(request.options, options[0])));
    };
    return method;
}

void addOwnMethods() {
    static const bool isDone = [] {
        addMethod(constantCache(0.5f));
        addMethod(flat());
        return true;
    }();
    static_cast<void>(isDone);
}

RenderRequest furnace(const std::string& method) {
    RenderRequest request;
    request.scene = IRRADIA_BIN_DIR "/../scenes/furnace-sphere.glb";
    request.method = method;
    request.size = {48, 32};
    request.device.validation = true;
    return request;
}

double meanOf(const FilmImage& film) {
    double sum = 0.0;
    for (const glm::vec3& pixel : film.mean) sum += (double(pixel.r) + pixel.g + pixel.b) / 3.0;
    return sum / static_cast<double>(film.mean.size());
}

} // namespace

TEST_CASE("a cache and a method are each added by one row of the table") {
    addOwnMethods();
    const std::vector<std::string> names = methodNames();
    CHECK(std::vector(names.begin(), names.begin() + 3) ==
          std::vector<std::string>{"pt", "nrc", "cache-view"});
    CHECK(names.size() == 5);
    expectError(ExitCode::Usage, "there are pt, nrc, cache-view, constant, flat",
                [] { findMethod("radiosity"); });
    expectError(ExitCode::Internal, "a method flat already", [] { addMethod(flat()); });
    expectError(ExitCode::Usage, "it is empty", [] { requireApplies(findMethod("flat"), Scene{}); });
}

// Emission 1/2 is seen, and 1/2 more is what the cache says.
TEST_CASE("a session renders a cache of somebody else's as it does the project's own") {
    addOwnMethods();
    RenderSession session(furnace("constant"));
    session.renderWarmupFrame(0);
    CHECK(std::abs(meanOf(session.readFilm()) - 1.0) < 1e-6);
    CHECK(session.device().validationMessages() == 0);
}

TEST_CASE("a session renders a method of somebody else's, with its own option and step of preparation") {
    addOwnMethods();
    RenderRequest request = furnace("flat");
    request.methodOptions["grey"] = "0.25";
    RenderSession session(request);
    session.renderFrame(0);
    CHECK(session.readFilm().mean == std::vector(48 * 32, glm::vec3(0.25f)));
    CHECK(session.attributes().at("prepared") == "4");
    CHECK(session.statistics().records == 0);
}

TEST_CASE("a session changes its method and its camera, and goes on with what it had where that fails") {
    addOwnMethods();
    RenderSession session(furnace("pt"));
    session.renderFrame(0);
    const std::vector<glm::vec3> traced = session.readFilm().mean;
    session.setMethod("flat");
    CHECK(session.method().name == "flat");
    session.renderFrame(0);
    CHECK(session.readFilm().mean == std::vector(48 * 32, glm::vec3(0.5f)));
    expectError(ExitCode::Usage, "no preset none", [&] { session.setMethod("nrc", {{"preset", "none"}}); });
    CHECK(session.method().name == "flat");
    session.setMethod("nrc", {{"preset", "fast"}});
    session.renderFrame(0);
    CHECK(session.statistics().records > 0);
    session.setMethod("pt");
    session.renderFrame(0);
    CHECK(session.readFilm().mean == traced);
    Camera camera = session.camera();
    camera.verticalFov *= 0.5f;
    session.setCamera(camera);
    session.renderFrame(0);
    CHECK(session.readFilm().frames == 1);
    CHECK(session.readFilm().mean != traced);
    CHECK(session.device().validationMessages() == 0);
}
