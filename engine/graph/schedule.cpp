#include "engine/graph/schedule.h"
#include "engine/error.h"
#include <algorithm>
#include <unordered_map>

namespace irradia {
namespace {

constexpr AccessKinds kHost = kindBit(AccessKind::Host);

bool overlap(const Access& a, const Access& b) {
    return a.resource == b.resource && a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes;
}

bool hazard(const Access& earlier, const Access& later) {
    return (earlier.write || later.write) && overlap(earlier, later);
}

void refuseTexelReadOfWritten(const ScheduledPass& pass) {
    for (const Access& written : pass.accesses)
        for (const Access& texel : pass.accesses)
            if (&written != &texel && written.write && texel.read && texel.kind == AccessKind::Texel &&
                overlap(written, texel))
                fail(ExitCode::Internal, "pass {}: writes bytes of buffer {} ({:#x}) that it reads as texels",
                     pass.name, written.name, written.resource);
}

// The accesses so far that a later pass may still have to wait for.
class Outstanding {
public:
    explicit Outstanding(std::span<const ScheduledPass> passes) {
        for (const ScheduledPass& pass : passes)
            for (const Access& access : pass.accesses)
                resources_[access.resource].kinds |= kindBit(access.kind);
    }

    // The kind of `later` if it must wait for an earlier access and no barrier makes it wait yet, else none.
    AccessKinds hazards(const Access& later) const {
        const AccessKinds kind = kindBit(later.kind);
        const std::vector<Past>& past = resources_.at(later.resource).past;
        const bool waits = std::any_of(past.begin(), past.end(), [&](const Past& earlier) {
            return (earlier.orderedBefore & kind) == 0 && hazard(earlier.access, later);
        });
        return waits ? kind : 0;
    }

    Barrier order(AccessKinds after) {
        Barrier barrier;
        barrier.after = after;
        for (auto& [id, resource] : resources_) {
            for (Past& past : resource.past) {
                if ((past.orderedBefore & after) == after) continue;
                past.orderedBefore |= after;
                if (past.access.write) barrier.writesBefore |= kindBit(past.access.kind);
                if (past.access.read) barrier.readsBefore |= kindBit(past.access.kind);
            }
            const AccessKinds all = resource.kinds;
            std::erase_if(resource.past, [&](const Past& past) { return (past.orderedBefore & all) == all; });
        }
        return barrier;
    }

    void add(const Access& access) { resources_.at(access.resource).past.push_back({access, 0}); }

private:
    struct Past {
        Access access;
        AccessKinds orderedBefore = 0; // kinds of later accesses that a barrier already makes wait
    };
    struct Resource {
        AccessKinds kinds = 0; // of all its accesses: one ordered before all of them needs no further thought
        std::vector<Past> past;
    };
    std::unordered_map<uint64_t, Resource> resources_;
};

AccessKinds kindsOf(std::span<const ScheduledPass> passes) {
    AccessKinds kinds = 0;
    for (const ScheduledPass& pass : passes)
        for (const Access& access : pass.accesses) kinds |= kindBit(access.kind);
    return kinds;
}

} // namespace

std::vector<Barrier> schedule(std::span<const ScheduledPass> passes) {
    const AccessKinds onDevice = kindsOf(passes) & ~kHost;
    Outstanding outstanding(passes);
    std::vector<Barrier> barriers;
    for (const ScheduledPass& pass : passes) {
        refuseTexelReadOfWritten(pass);
        AccessKinds after = 0;
        for (const Access& access : pass.accesses) after |= outstanding.hazards(access);
        if (after & ~kHost) after |= onDevice;
        barriers.push_back(after ? outstanding.order(after) : Barrier{});
        for (const Access& access : pass.accesses) outstanding.add(access);
    }
    return barriers;
}

} // namespace irradia
