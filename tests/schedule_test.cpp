// The barriers between passes, and the cuts between submissions, without a device.
#include "engine/error.h"
#include "engine/graph/schedule.h"
#include "engine/graph/slices.h"
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <random>

using namespace irradia;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;

namespace {

constexpr AccessKinds kStorage = kindBit(AccessKind::Storage);
constexpr AccessKinds kTexel = kindBit(AccessKind::Texel);
constexpr AccessKinds kUniform = kindBit(AccessKind::Uniform);
constexpr AccessKinds kIndirect = kindBit(AccessKind::Indirect);
constexpr AccessKinds kTransfer = kindBit(AccessKind::Transfer);
constexpr AccessKinds kHost = kindBit(AccessKind::Host);

// Bytes [from, to) of buffer `resource`.
Access reads(uint64_t resource, AccessKind kind = AccessKind::Storage, uint64_t from = 0, uint64_t to = 64) {
    return {resource, from, to - from, kind, true, false};
}
Access writes(uint64_t resource, AccessKind kind = AccessKind::Storage, uint64_t from = 0, uint64_t to = 64) {
    return {resource, from, to - from, kind, false, true};
}

std::vector<Barrier> barriers(const std::vector<std::vector<Access>>& passes) {
    std::vector<ScheduledPass> scheduled;
    for (const auto& accesses : passes)
        scheduled.push_back({fmt::format("pass {}", scheduled.size()), accesses});
    const std::vector<Barrier> result = schedule(scheduled);
    REQUIRE(result.size() == passes.size());
    for (const Barrier& barrier : result)
        if (!barrier.needed()) CHECK((barrier.writesBefore | barrier.readsBefore) == 0);
    return result;
}

std::vector<bool> needed(const std::vector<std::vector<Access>>& passes) {
    std::vector<bool> result;
    for (const Barrier& barrier : barriers(passes)) result.push_back(barrier.needed());
    return result;
}

using Needed = std::vector<bool>;

} // namespace

TEST_CASE("a read after a write, a write after a read and a write after a write wait") {
    CHECK(needed({{writes(1)}, {reads(1)}}) == Needed{false, true});
    CHECK(needed({{reads(1)}, {writes(1)}}) == Needed{false, true});
    CHECK(needed({{writes(1)}, {writes(1)}}) == Needed{false, true});
    CHECK(needed({{writes(1)}, {reads(2)}, {reads(1)}}) == Needed{false, false, true});
}

TEST_CASE("without a hazard there is no barrier") {
    CHECK(needed({}) == Needed{});
    CHECK(needed({{reads(1)}, {reads(1)}, {reads(1, AccessKind::Texel)}}) == Needed{false, false, false});
    CHECK(needed({{writes(1)}, {writes(2)}, {reads(3)}}) == Needed{false, false, false});
    CHECK(needed({{reads(1), writes(1, AccessKind::Storage, 64, 128)}}) == Needed{false});
}

TEST_CASE("hazards are keyed on byte ranges") {
    const auto storage = AccessKind::Storage;
    CHECK(needed({{writes(1, storage, 0, 64)}, {reads(1, storage, 64, 128)}}) == Needed{false, false});
    CHECK(needed({{writes(1, storage, 64, 128)}, {reads(1, storage, 0, 64)}}) == Needed{false, false});
    CHECK(needed({{writes(1, storage, 0, 65)}, {reads(1, storage, 64, 128)}}) == Needed{false, true});
    CHECK(needed({{writes(1, storage, 64, 65)}, {reads(1, storage, 0, 128)}}) == Needed{false, true});
    CHECK(needed({{writes(1, storage, 0, 128)}, {reads(1, storage, 64, 65)}}) == Needed{false, true});
    CHECK(needed({{writes(1, storage, 0, 64), writes(1, storage, 64, 128)}, {reads(1, storage, 100, 101)}}) ==
          Needed{false, true});
}

TEST_CASE("a barrier answers the later hazards against everything before it") {
    // Both buffers are written by pass 0; the barrier before pass 1 orders both, so pass 2 needs none.
    CHECK(needed({{writes(1), writes(2)}, {reads(1)}, {reads(2)}}) == Needed{false, true, false});
    // What pass 1 itself writes is not ordered by the barrier before it.
    CHECK(needed({{writes(1)}, {reads(1), writes(2)}, {reads(2)}}) == Needed{false, true, true});
    // Another kind of access on the device is answered too.
    const auto transfer = AccessKind::Transfer;
    const auto mixed =
        barriers({{writes(1), writes(2)}, {reads(1)}, {reads(2, transfer)}, {reads(2, AccessKind::Texel)}});
    CHECK(mixed[1].after == (kStorage | kTransfer | kTexel));
    CHECK(!mixed[2].needed());
    CHECK(!mixed[3].needed());
    // A write after that read waits again.
    CHECK(needed({{writes(1)}, {reads(1)}, {reads(1)}, {writes(1)}}) == Needed{false, true, false, true});
}

TEST_CASE("a barrier names the kinds before and after it") {
    const auto filled =
        barriers({{writes(1, AccessKind::Transfer)}, {reads(1, AccessKind::Texel), writes(2)}});
    CHECK(filled[1].writesBefore == kTransfer);
    CHECK(filled[1].readsBefore == 0);
    CHECK(filled[1].after == (kTransfer | kTexel | kStorage));

    const auto overwritten = barriers({{reads(1, AccessKind::Uniform)}, {writes(1)}});
    CHECK(overwritten[1].writesBefore == 0);
    CHECK(overwritten[1].readsBefore == kUniform);
    CHECK((overwritten[1].after & kStorage) != 0);

    const auto indirect = barriers({{writes(1)}, {reads(1, AccessKind::Indirect)}});
    CHECK(indirect[1].writesBefore == kStorage);
    CHECK((indirect[1].after & kIndirect) != 0);

    const Access both{1, 0, 64, AccessKind::Storage, true, true};
    const auto updated = barriers({{both}, {both}});
    CHECK(updated[1].writesBefore == kStorage);
    CHECK(updated[1].readsBefore == kStorage);
}

TEST_CASE("only the host's own accesses wait with the host") {
    const auto host = AccessKind::Host;
    const auto frame = barriers({{writes(1), writes(2)}, {reads(1)}, {reads(2), reads(1)}, {reads(2, host)}});
    CHECK(frame[1].needed());
    CHECK((frame[1].after & kHost) == 0);
    CHECK(!frame[2].needed());
    CHECK(frame[3].writesBefore == kStorage);
    CHECK(frame[3].after == kHost);

    const auto before = barriers({{writes(1, host)}, {reads(1, AccessKind::Uniform)}});
    CHECK(before[1].writesBefore == kHost);
    CHECK((before[1].after & kUniform) != 0);
}

TEST_CASE("a pass cannot write what it reads as texels through another access") {
    const auto texel = AccessKind::Texel;
    const auto refused = [](const std::vector<Access>& accesses) {
        ScheduledPass pass{"scatter", accesses};
        CHECK_THROWS_MATCHES(schedule(std::span(&pass, 1)), Error,
                             MessageMatches(ContainsSubstring("pass scatter: writes bytes of buffer rays") &&
                                            ContainsSubstring("reads as texels")));
    };
    const auto named = [](Access access) {
        access.name = "rays";
        return access;
    };
    refused({named(reads(1, texel)), named(writes(1))});
    refused({named(writes(1, texel, 32, 96)), named(reads(1, texel))});
    // Apart, or read otherwise, or updated through one and the same view.
    CHECK_NOTHROW(barriers({{reads(1, texel), writes(1, AccessKind::Storage, 64, 128)}}));
    CHECK_NOTHROW(barriers({{reads(1), writes(1)}}));
    CHECK_NOTHROW(barriers({{reads(2, texel), writes(1)}}));
    CHECK_NOTHROW(barriers({{Access{1, 0, 64, texel, true, true}}}));
}

// Every pair of conflicting accesses must be separated by a barrier whose masks hold both: checked pair by
// pair on random frames, against the definition and not the algorithm.
TEST_CASE("in random frames each hazard is covered and each barrier is needed") {
    std::mt19937 random(1);
    const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
    uint32_t hazards = 0;
    uint32_t barrierCount = 0;
    for (int frame = 0; frame < 300; ++frame) {
        std::vector<std::vector<Access>> passes(2 + below(10));
        for (auto& pass : passes) {
            for (uint32_t i = 0, count = 1 + below(3); i < count; ++i) {
                const uint64_t from = 64 * below(3);
                constexpr AccessKind kKinds[] = {AccessKind::Storage, AccessKind::Transfer, AccessKind::Host,
                                                 AccessKind::Indirect};
                const AccessKind kind = kKinds[below(4)];
                const bool write = kind != AccessKind::Indirect && below(2) == 0;
                pass.push_back({below(3), from, 64 * (1 + below(2)), kind, !write, write});
            }
        }
        const std::vector<Barrier> result = barriers(passes);
        const auto conflict = [](const Access& a, const Access& b) {
            return a.resource == b.resource && (a.write || b.write) && a.offset < b.offset + b.bytes &&
                   b.offset < a.offset + a.bytes;
        };
        const auto covers = [](const Barrier& barrier, const Access& a, const Access& b) {
            const AccessKinds before = a.write ? barrier.writesBefore : barrier.readsBefore;
            return (before & kindBit(a.kind)) != 0 && (barrier.after & kindBit(b.kind)) != 0;
        };
        std::vector<bool> justified(passes.size(), false);
        for (size_t later = 0; later < passes.size(); ++later) {
            for (size_t earlier = 0; earlier < later; ++earlier) {
                for (const Access& a : passes[earlier]) {
                    for (const Access& b : passes[later]) {
                        if (!conflict(a, b)) continue;
                        ++hazards;
                        bool covered = false;
                        for (size_t i = earlier + 1; i < later; ++i) covered |= covers(result[i], a, b);
                        if (!covered) justified[later] = true;
                        REQUIRE((covered || covers(result[later], a, b)));
                    }
                }
            }
        }
        for (size_t i = 0; i < passes.size(); ++i) {
            barrierCount += result[i].needed();
            REQUIRE(result[i].needed() == justified[i]);
        }
    }
    CHECK(hazards > 1000);
    CHECK(barrierCount > 500);
    CHECK(barrierCount < hazards);
}

TEST_CASE("a frame is cut only where allowed, into submissions of about the target") {
    const auto starts = [](const std::vector<SliceCandidate>& passes) { return sliceStarts(passes, 100); };
    using Starts = std::vector<size_t>;
    CHECK(starts({}) == Starts{0});
    CHECK(starts({{500, false}, {500, false}}) == Starts{0});
    CHECK(starts({{40, false}, {40, true}, {40, true}, {40, true}, {40, true}}) == Starts{0, 2, 4});
    CHECK(starts({{40, false}, {40, false}, {40, true}, {40, false}, {40, true}}) == Starts{0, 2, 4});
    CHECK(starts({{500, false}, {1, true}, {500, true}}) == Starts{0, 1, 2});
    CHECK(starts({{100, true}, {100, true}, {100, true}}) == Starts{0, 1, 2});
    CHECK(starts({{50, false}, {50, true}, {0, true}}) == Starts{0});
}
