#include "render_frames.h"

#include "engine/error.h"
#include "engine/log.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/progress.h"
#include <bit>
#include <chrono>
#include <cmath>

namespace irradia {
namespace {

constexpr uint32_t kMostFrames = 1'000'000'000;
constexpr double kWarmupShare = 0.5; // of the time, at most

class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// How much of the frames or of the time is over, whichever is further.
double fraction(uint32_t done, uint32_t frames, const Stopwatch& clock, double seconds) {
    return std::max(double(done) / frames, std::min(clock.seconds() / seconds, 1.0));
}

// Returns how many frames there was time for.
uint32_t warmUp(RenderSession& session, const FramePlan& plan, const std::string& progress,
                const Stopwatch& clock) {
    stopIfInterrupted();
    if (plan.warmup == 0) return 0;
    const double seconds = kWarmupShare * plan.seconds;
    ProgressMeter meter("warmup", progress);
    uint32_t done = 0;
    for (; done < plan.warmup && clock.seconds() < seconds; ++done) {
        session.renderWarmupFrame(done);
        meter.update(fraction(done + 1, plan.warmup, clock, seconds));
        if (const char* signal = interruptedBy())
            fail(ExitCode::Interrupted,
                 "interrupted by {} after {} of {} frames of warm-up: nothing is written", signal, done + 1,
                 plan.warmup);
    }
    meter.finish();
    session.endWarmup();
    if (done < plan.warmup)
        logLine("warm-up: {} of {} frames, in half of the {:g} s", done, plan.warmup, plan.seconds);
    return done;
}

FrameNote noteOf(RenderSession& session, uint32_t frames, double seconds) {
    const FilmImage film = session.readRawFilm();
    FrameNote note{frames, seconds, 0.0, std::nullopt, 0};
    for (const glm::vec3& pixel : film.mean) note.mean += luminance(pixel);
    note.mean /= static_cast<double>(film.mean.size());
    const RendererStatistics statistics = session.statistics();
    note.loss = statistics.loss;
    note.records = statistics.records;
    return note;
}

std::string endedBy(const FramePlan& plan, uint32_t end, const Stopwatch& clock) {
    if (const char* signal = interruptedBy()) return signal;
    if (end >= plan.end) return "frames";
    return clock.seconds() >= plan.seconds ? "time" : "";
}

} // namespace

FramePlan parseFrames(const std::string& text) {
    const size_t dash = text.find('-');
    const auto first = dash == std::string::npos ? 0u : toWhole(text.substr(0, dash), 0, kMostFrames);
    const auto end = toWhole(dash == std::string::npos ? text : text.substr(dash + 1), 1, kMostFrames);
    if (!first || !end || *first >= *end)
        fail(ExitCode::Usage, "--frames {}: not a number of frames from 1 to {}, nor a range A-B with A < B",
             text, kMostFrames);
    FramePlan plan;
    plan.first = *first;
    plan.end = *end;
    return plan;
}

void requireOwnSamples(const FramePlan& plan, uint32_t samplesPerFrame) {
    constexpr uint64_t kSamples = uint64_t{1} << 32;
    const uint64_t end = plan.end == UINT32_MAX ? plan.first + 1ull : plan.end;
    if ((end + plan.warmup) * samplesPerFrame > kSamples)
        fail(ExitCode::Usage, "--frames up to {} with --spp {}: a pixel has {} samples of its own, no more",
             end, samplesPerFrame, kSamples);
}

RenderedFrames renderFrames(RenderSession& session, const FramePlan& plan, const std::string& progress,
                            bool withHistory) {
    const Stopwatch clock;
    RenderedFrames run;
    run.warmup = warmUp(session, plan, progress, clock);
    run.first = run.end = plan.first;
    ProgressMeter meter("render", progress);
    while (run.endedBy.empty()) {
        session.renderFrame(run.end++);
        const uint32_t done = run.end - run.first;
        if (withHistory && std::has_single_bit(done))
            run.history.push_back(noteOf(session, done, clock.seconds()));
        meter.update(fraction(done, plan.end - plan.first, clock, plan.seconds));
        run.endedBy = endedBy(plan, run.end, clock);
    }
    meter.finish();
    run.seconds = clock.seconds();
    if (const uint32_t without = session.statistics().framesWithoutCache; without > 0)
        logLine("{} of {} frames were path traced: the cache had not learned yet", without,
                run.end - run.first);
    if (run.endedBy == "time" && plan.end != UINT32_MAX)
        logLine("time: {} of {} frames in the {:g} s", run.end - run.first, plan.end - plan.first,
                plan.seconds);
    return run;
}

} // namespace irradia
