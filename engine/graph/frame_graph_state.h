// What a FrameGraph holds: the passes declared so far and what submits them.
#pragma once

#include "engine/graph/descriptor_sets.h"
#include "engine/graph/pass_record.h"
#include "engine/graph/progress.h"
#include "engine/graph/timestamps.h"
#include <map>
#include <optional>

namespace irradia {

struct FrameGraph::State {
    struct Slice { // passes [first, end)
        size_t first = 0, end = 0;
    };

    State(Device& d, Profiler* p)
        : device(d)
        , profiler(p)
        , timeoutSeconds(d.isCpu() ? 600 : 60)
        , sets(d)
        , timestamps(d)
        , progress(d) {}
    ~State();

    static uint64_t nextList();
    PassRecord& add(const std::string& name);
    void end(size_t index); // the pass is complete: checks it
    std::vector<ScheduledPass> accesses() const;
    void numberRuns();
    std::vector<size_t> slices() const;
    void submitAll();
    void requireIdle(const std::string& what) const; // throws where a submission is to be waited for
    void clear();
    void record(const PassRecord& pass);
    void beginSubmission(uint32_t passCount);
    void submit(const Slice& slice);
    void finish(const Slice& slice); // waits for it, and keeps its times
    void keepTimes(size_t first);

    Device& device;
    Profiler* profiler;
    double timeoutSeconds;
    std::vector<PassRecord> passes;
    bool cutNext = false;
    bool isSubmitted = false;      // and not waited for
    std::optional<Slice> inFlight; // the last slice of these passes
    uint64_t list = nextList();    // number of these passes
    std::vector<std::function<void()>> whenExecuted;
    std::string section; // of the passes to come
    DescriptorSets sets;
    Timestamps timestamps;
    Progress progress;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
    std::map<std::string, std::vector<double>, std::less<>> lastTimes; // ms of each run of a pass name
};

} // namespace irradia
