// The cache follows a light that is switched: the rule by itself, and a room with two lamps.
#include "nrc/renderer/adaptation.h"
#include "nrc/renderer/nrc_renderer.h"
#include "tests/reference/simple_scenes.h"
#include "tests/support/expect_error.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fmt/ranges.h>

using namespace irradia;
using namespace irradia::test;

namespace {

Device& device() {
    return deviceWith(QuadAccess::Texel);
}

// The small box with a weaker second lamp on the ceiling; `on`: the stronger one shines.
constexpr size_t kStrongLamp = 3;
Scene room(bool on) {
    Scene scene = reference::smallBox();
    const uint32_t second = reference::addMaterial(scene, reference::lambert({}, {2.0f, 3.0f, 4.0f}));
    reference::addQuad(scene, second, {-0.8f, 0.99f, 0.3f}, {0.4f, 0, 0}, {0, 0, 0.4f});
    if (!on) scene.materials[kStrongLamp].emission = glm::vec3(0.0f);
    return scene;
}

PlannedStates bothStates() {
    PlannedStates states;
    for (const bool on : {false, true}) states.include(room(on));
    return states;
}

double meanOf(const FilmImage& film) {
    double sum = 0.0;
    for (const glm::vec3& pixel : film.mean) sum += 0.2126 * pixel.r + 0.7152 * pixel.g + 0.0722 * pixel.b;
    return sum / double(film.mean.size());
}

NrcOptions options(bool adapts) {
    NrcOptions options;
    options.paths.width = options.paths.height = 32;
    options.paths.maxBounces = 8;
    options.paths.samplesPerFrame = 4;
    options.config = nrcPreset("fast");
    options.config.adaptation.on = adapts;
    return options;
}

double truth(bool on) {
    const Scene scene = room(on);
    const GpuScene gpu = uploadScene(device(), packScene(scene), buildBvh(scene));
    PathTracerOptions paths = options(false).paths;
    paths.maxBounces = 32;
    paths.samplesPerFrame = 128; // the mean's error is 1 %
    paths.seed = 2;
    WavefrontPathTracer tracer(device(), gpu, paths);
    tracer.renderFrame(scene.cameras[0], 0);
    return meanOf(tracer.readFilm());
}

// The room with a cache, rendered while its strong lamp is switched.
class SwitchedRoom {
public:
    explicit SwitchedRoom(bool adapts)
        : gpu_(uploadScene(device(), packScene(room(true), bothStates()), buildBvh(room(true))))
        , renderer_(device(), gpu_, bounds(), options(adapts)) {}

    // Means over the truth's mean, of 30 frames in groups of 5.
    std::vector<double> render(bool on, double expected) {
        updateScene(device(), room(on), gpu_);
        std::vector<double> ratios;
        for (int group = 0; group < 6; ++group) {
            renderer_.forgetFilm();
            for (int i = 0; i < 5; ++i) renderer_.renderFrame(room(on).cameras[0], frame_++);
            ratios.push_back(meanOf(renderer_.tracer().readFilm()) / expected);
        }
        return ratios;
    }
    const NrcRenderer& renderer() const { return renderer_; }

private:
    static Bounds bounds() { return sceneBounds(room(true)); }

    GpuScene gpu_;
    NrcRenderer renderer_;
    uint32_t frame_ = 0;
};

Adaptation afterAgreement(const AdaptationConfig& config) {
    Adaptation adaptation(config, 4, 0.99);
    for (int frame = 0; frame < 40; ++frame) adaptation.observe(1.0f, 1.0f);
    return adaptation;
}

// Each frame by itself.
AdaptationConfig unsmoothed() {
    return {.smoothing = 0.0f};
}

} // namespace

TEST_CASE("effort rises with disagreement and comes back") {
    AdaptationConfig config = unsmoothed();
    Adaptation adaptation(config, 4, 0.99);
    const auto isCalm = [&] { return adaptation.effort().steps == 0 && !adaptation.effort().emaDecay; };
    CHECK(isCalm());
    adaptation.observe(1.0f, 1.2f); // noise
    CHECK(isCalm());
    for (const auto& [prediction, target] :
         {std::pair{1.0f, 3.0f}, {3.0f, 1.0f}, {1.0f, 0.0f}, {-1.0f, 1.0f}}) {
        Adaptation urgent = adaptation;
        urgent.observe(prediction, target);
        CHECK(urgent.urgency() == 1.0f);
        CHECK(urgent.effort().steps == 16);
        CHECK(std::abs(*urgent.effort().emaDecay - 0.9) < 1e-6);
    }
    adaptation.observe(1.0f, 1.01f * std::exp(0.5f) - 0.01f); // half the way from the threshold to full
    CHECK(std::abs(adaptation.urgency() - 0.5f) < 1e-4f);
    CHECK(adaptation.effort().steps == 10);
    CHECK(std::abs(*adaptation.effort().emaDecay - (1.0 - std::sqrt(0.01 * 0.1))) < 1e-5);
    int frames = 0;
    for (; !isCalm() && frames < 100; ++frames) adaptation.observe(1.0f, 1.0f);
    CHECK(frames == 25); // 0.5 * 0.85^25 < 0.01
    adaptation.observe(NAN, 1.0f);
    adaptation.observe(0.0f, 0.0f);
    CHECK(isCalm());

    config.on = false;
    Adaptation off(config, 4, 0.99);
    off.observe(1.0f, 9.0f);
    CHECK((off.effort().steps == 0 && !off.effort().emaDecay));
}

TEST_CASE("the learning rate falls with agreement, and is whole again where all is urgent") {
    AdaptationConfig config = unsmoothed();
    Adaptation adaptation(config, 4, 0.99);
    const auto agree = [&](int frames) {
        for (int frame = 0; frame < frames; ++frame) adaptation.observe(1.0f, 1.0f);
        return adaptation.effort().learningRate;
    };
    CHECK(agree(256) == 1.0);  // 1,024 steps
    CHECK(agree(256) == 0.5);  // as many again
    CHECK(agree(512) == 0.25); // and again
    CHECK(agree(512) == 0.2);
    adaptation.observe(1.0f, 9.0f);
    CHECK(adaptation.effort().learningRate == 1.0);
    CHECK(agree(256) == 1.0); // until long after
    const auto settled = [&] {
        adaptation = Adaptation(config, 4, 0.99);
        return agree(1024);
    };
    CHECK(settled() == 0.25);
    config.on = false;
    CHECK(settled() == 1.0);
    config = unsmoothed();
    config.settling = 0;
    CHECK(settled() == 1.0);
}

TEST_CASE("the younger the cache, the more of its suffixes are unbiased") {
    AdaptationConfig config = unsmoothed();
    Adaptation adaptation(config, 4, 0.99);
    CHECK(adaptation.unbiasedShare(0.0625f) == 1.0f);
    CHECK(adaptation.unbiasedShare(0.0f) == 0.0f); // none wanted, none ever
    for (int frame = 0; frame < 128; ++frame) adaptation.observe(1.0f, 1.0f);
    CHECK(adaptation.unbiasedShare(0.0625f) == 0.5f); // 512 steps
    for (int frame = 0; frame < 10000; ++frame) adaptation.observe(1.0f, 1.0f);
    CHECK(adaptation.unbiasedShare(0.0625f) == 0.0625f);
    adaptation.observe(1.0f, 9.0f);
    CHECK(adaptation.unbiasedShare(0.0625f) == 1.0f); // all is urgent
    config.on = false;
    CHECK(Adaptation(config, 4, 0.99).unbiasedShare(0.0625f) == 0.0625f);
    config.on = true;
    config.youth = 0;
    CHECK(Adaptation(config, 4, 0.99).unbiasedShare(0.0625f) == 0.0625f);
}

TEST_CASE("what goes to both sides is noise, what goes to one is not") {
    // e^0.6 too bright, as much too dark, and so on: beyond the threshold each time.
    Adaptation adaptation = afterAgreement({}), plain = afterAgreement(unsmoothed());
    for (int frame = 0; frame < 20; ++frame) {
        const float target = std::exp(frame % 2 ? 0.6f : -0.6f);
        adaptation.observe(1.0f, target);
        plain.observe(1.0f, target);
        CHECK(adaptation.urgency() == 0.0f);
        CHECK(plain.urgency() > 0.5f);
    }
    // One frame is little proof, whatever its target; three are enough.
    const auto urgencies = [](float target) {
        Adaptation after = afterAgreement({});
        std::vector<float> all;
        for (int frame = 0; frame < 3; ++frame) {
            after.observe(1.0f, target);
            all.push_back(after.urgency());
        }
        return all;
    };
    for (const float target : {9.0f, 1e9f, 0.0f}) {
        const auto urgency = urgencies(target);
        CHECK(std::abs(urgency[0] - 0.3f) < 1e-4f);  // (0.4 * 1.05 - 0.3) / 0.4
        CHECK(std::abs(urgency[1] - 0.93f) < 1e-4f); // (0.64 * 1.05 - 0.3) / 0.4
        CHECK(urgency[2] == 1.0f);
    }
    Adaptation first(AdaptationConfig{}, 4, 0.99);
    first.observe(0.0f, 1.0f); // all there is to go by
    CHECK(first.urgency() == 1.0f);
    adaptation.observe(1.0f, NAN); // and does not stay
    for (int frame = 0; frame < 3; ++frame) adaptation.observe(1.0f, 9.0f);
    CHECK(adaptation.urgency() == 1.0f);
}

TEST_CASE("adaptation is configured as JSON") {
    const auto parse = [](const std::string& adaptation) {
        return parseNrcConfig(R"({"base": "balanced", "adaptation": )" + adaptation + "}", "x").adaptation;
    };
    CHECK(parse("{}") == AdaptationConfig{});
    CHECK_FALSE(parse("\"off\"").on);
    const auto config = parse(R"({"most_steps": 8, "full": 2})");
    CHECK((config.on && config.mostSteps == 8 && config.full == 2.0f && config.youth == 512));
    CHECK(parse(R"({"youth": 64})").youth == 64);
    CHECK(parse(R"({"settling": 9})").settling == 9);
    CHECK(parse(R"({"smoothing": 0.5})").smoothing == 0.5f);
    CHECK(parse(R"({"threshold": 0.3, "full": 0.3})").full == 0.3f); // at once
    for (const char* text :
         {R"("maybe")", R"({"full": 0.1})", R"({"shortest_ema": 1})", R"({"smoothing": 1})", "3"})
        expectError(ExitCode::BadData, "adaptation", [&] { parse(text); });
}

// Mean over truth of five frames each after the lamp went off: 1.65 1.03 1.04 1.03 1.03 0.99 with adaptation,
// 2.02 1.91 1.69 1.49 1.36 1.23 without.
TEST_CASE("a lamp that is switched is seen within 30 frames, and later without adaptation") {
    const double dark = truth(false), bright = truth(true);
    SwitchedRoom adapting(true), plain(false);
    const auto isThere = [](const std::vector<double>& ratios) {
        return std::abs(ratios.back() - 1.0) < 0.1;
    };
    const auto first = adapting.render(true, bright), off = adapting.render(false, dark);
    const uint32_t stepsWhenOff = adapting.renderer().counts().training.steps;
    const auto on = adapting.render(true, bright);
    INFO(fmt::format("adapting: at first {:.2f}, off {:.2f}, on {:.2f}, steps {}, then {}",
                     fmt::join(first, " "), fmt::join(off, " "), fmt::join(on, " "), stepsWhenOff,
                     adapting.renderer().counts().training.steps));
    CHECK(isThere(first));
    CHECK(isThere(off));
    CHECK(isThere(on));

    const auto firstPlain = plain.render(true, bright), offPlain = plain.render(false, dark);
    INFO(fmt::format("plain: at first {:.2f}, off {:.2f}", fmt::join(firstPlain, " "),
                     fmt::join(offPlain, " ")));
    CHECK_FALSE(isThere(offPlain));
    CHECK(offPlain.back() > off.back() + 0.2);
    CHECK(plain.renderer().counts().training.steps == 60 * options(false).config.steps);
    CHECK(device().validationMessages() == 0);
}
