// Times by pass name over frames.
#include "engine/gpu/profiler.h"
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

using namespace irradia;
using Catch::Matchers::WithinRel;

TEST_CASE("runs of a pass are summed within a frame, frames are ranked") {
    Profiler profiler;
    for (int frame = 1; frame <= 10; ++frame) {
        profiler.record("scatter", frame);
        profiler.record("tonemap", 1);
        profiler.record("scatter", frame);
        profiler.endFrame(100.0 * frame);
    }
    const auto rows = profiler.rows();
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].name == "scatter");
    CHECK(rows[1].name == "tonemap");
    CHECK_THAT(rows[0].p50, WithinRel(11.0));
    CHECK_THAT(rows[0].p90, WithinRel(18.0));
    CHECK_THAT(rows[0].mean, WithinRel(11.0));
    CHECK(rows[0].runs == 20);
    CHECK_THAT(profiler.lastFrame("scatter"), WithinRel(20.0));
    CHECK_THAT(profiler.wall().p50, WithinRel(550.0));
    CHECK_THAT(profiler.wall().p90, WithinRel(900.0));
    CHECK(profiler.frames() == 10);
    profiler.reset();
    CHECK(profiler.frames() == 0);
    CHECK(profiler.rows().empty());
}

TEST_CASE("a pass that misses frames took no time in them") {
    Profiler profiler;
    profiler.record("early", 4);
    profiler.endFrame(1);
    profiler.record("late", 3);
    profiler.endFrame(1);
    profiler.endFrame(1);
    const auto rows = profiler.rows();
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].p50 == 0);
    CHECK_THAT(rows[0].p90, WithinRel(4.0));
    CHECK_THAT(rows[1].mean, WithinRel(1.0));
    CHECK(profiler.lastFrame("late") == 0);
    CHECK(profiler.lastFrame("unheard of") == 0);
}

TEST_CASE("of many frames some are kept, evenly") {
    Profiler profiler;
    constexpr int kFrames = 100000;
    for (int frame = 0; frame < kFrames; ++frame) {
        profiler.record("scatter", frame);
        profiler.endFrame(2.0 * frame);
    }
    CHECK(profiler.frames() == kFrames);
    CHECK(profiler.rows()[0].runs == kFrames);
    CHECK(profiler.lastFrame("scatter") == kFrames - 1);
    // Kept are at least 2,048 of them, every 32nd.
    CHECK_THAT(profiler.rows()[0].p50, Catch::Matchers::WithinAbs(0.5 * kFrames, 64));
    CHECK_THAT(profiler.wall().p90, Catch::Matchers::WithinAbs(1.8 * kFrames, 128));
}
