// Running the declared passes: barriers, submissions, times.
#include "engine/error.h"
#include "engine/gpu/commands.h"
#include "engine/graph/barrier.h"
#include "engine/graph/frame_graph_state.h"
#include "engine/graph/slices.h"
#include <algorithm>
#include <bit>
#include <set>

namespace irradia {
namespace {

constexpr double kSliceMilliseconds = 100;

} // namespace

FrameGraph::FrameGraph(Device& device, Profiler* profiler)
    : state_(std::make_unique<State>(device, profiler)) {
    State& s = *state_;
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = device.queueFamily();
    check(vkCreateCommandPool(device.handle(), &pool, nullptr, &s.pool), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = s.pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &info, &s.commands), "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(device.handle(), &fence, nullptr, &s.fence), "vkCreateFence");
    s.beginLabel = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(device.instance(), "vkCmdBeginDebugUtilsLabelEXT"));
    s.endLabel = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(device.instance(), "vkCmdEndDebugUtilsLabelEXT"));
}

FrameGraph::State::~State() {
    if (device.abandoned()) return;
    // Dropped while in flight: nothing is freed before the device is done with it.
    const auto nanoseconds = static_cast<uint64_t>(timeoutSeconds * 1e9);
    if (inFlight && vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, nanoseconds) != VK_SUCCESS) return;
    vkDestroyFence(device.handle(), fence, nullptr);
    vkDestroyCommandPool(device.handle(), pool, nullptr);
}

// The passes' accesses, and the host's, which reads mapped buffers when all is done. (What it writes before
// is made visible by the submission.)
std::vector<ScheduledPass> FrameGraph::State::accesses() const {
    std::vector<ScheduledPass> scheduled;
    ScheduledPass host{"host", {}};
    std::set<const Buffer*> mapped;
    for (const PassRecord& pass : passes) {
        scheduled.push_back(accessesOf(pass));
        for (const PassBinding& binding : pass.bindings)
            if (binding.range.buffer->isMapped()) mapped.insert(binding.range.buffer);
        if (pass.target && pass.target->buffer->isMapped()) mapped.insert(pass.target->buffer);
    }
    for (const Buffer* buffer : mapped)
        host.accesses.push_back({std::bit_cast<uint64_t>(buffer->handle()), 0, buffer->bytes(),
                                 AccessKind::Host, true, false, buffer->name()});
    scheduled.push_back(host);
    return scheduled;
}

void FrameGraph::State::numberRuns() {
    std::map<std::string_view, uint32_t> runs;
    for (PassRecord& pass : passes) pass.run = runs[pass.name]++;
}

// A pass is expected to take as long as the same run of its name last took; one that never ran, a whole
// slice.
std::vector<size_t> FrameGraph::State::slices() const {
    std::vector<SliceCandidate> candidates;
    for (const PassRecord& pass : passes) {
        const auto last = lastTimes.find(pass.name);
        const bool known = last != lastTimes.end() && pass.run < last->second.size();
        candidates.push_back({known ? last->second[pass.run] : kSliceMilliseconds, pass.cutBefore});
    }
    return sliceStarts(candidates, kSliceMilliseconds);
}

void FrameGraph::State::record(const PassRecord& pass) {
    if (beginLabel) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = pass.name.c_str();
        beginLabel(commands, &label);
    }
    if (pass.kernel) {
        const VkDescriptorSet set = sets.make(pass);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.kernel->pipeline());
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.kernel->layout(), 0, 1, &set,
                                0, nullptr);
        if (pass.pushBytes > 0)
            vkCmdPushConstants(commands, pass.kernel->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               pass.pushBytes, pass.push.data());
    }
    switch (pass.command) {
    case PassRecord::Command::None:
        break;
    case PassRecord::Command::Dispatch:
        vkCmdDispatch(commands, pass.groups, 1, 1);
        break;
    case PassRecord::Command::DispatchIndirect:
        vkCmdDispatchIndirect(commands, pass.argument->buffer->handle(), pass.argument->offset);
        break;
    case PassRecord::Command::Fill:
        vkCmdFillBuffer(commands, pass.target->buffer->handle(), pass.target->offset, pass.target->bytes,
                        pass.value);
        break;
    case PassRecord::Command::Update:
        vkCmdUpdateBuffer(commands, pass.target->buffer->handle(), pass.target->offset, pass.target->bytes,
                          pass.content.data());
        break;
    case PassRecord::Command::Copy: {
        const VkBufferCopy region{pass.argument->offset, pass.target->offset, pass.target->bytes};
        vkCmdCopyBuffer(commands, pass.argument->buffer->handle(), pass.target->buffer->handle(), 1, &region);
        break;
    }
    }
    if (endLabel) endLabel(commands);
}

void FrameGraph::State::beginSubmission(uint32_t passCount) {
    check(vkResetCommandPool(device.handle(), pool, 0), "vkResetCommandPool");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    orderAfterEarlierSubmissions(commands);
    timestamps.begin(commands, passCount);
    progress.begin(passCount);
}

void FrameGraph::State::submit(const Slice& slice) {
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    device.submit(commands, fence, passes[slice.first].name);
}

void FrameGraph::State::finish(const Slice& slice) {
    try {
        device.wait(fence, passes[slice.first].name + " to " + passes[slice.end - 1].name, timeoutSeconds);
    } catch (const Error& error) {
        fail(error.code(), "{}; the last pass was {}", error.what(),
             passes[slice.first + progress.lastReached()].name);
    }
    keepTimes(slice.first);
}

void FrameGraph::State::keepTimes(size_t first) {
    const std::vector<double> times = timestamps.milliseconds();
    for (size_t i = 0; i < times.size(); ++i) {
        const PassRecord& pass = passes[first + i];
        std::vector<double>& last = lastTimes[pass.name];
        last.resize(std::max<size_t>(last.size(), pass.run + 1));
        last[pass.run] = times[i];
        if (profiler) profiler->record(pass.name, times[i]);
    }
}

void FrameGraph::State::submitAll() {
    if (passes.back().command == PassRecord::Command::None)
        fail(ExitCode::Internal, "pass {}: is declared but never dispatched", passes.back().name);

    const std::vector<Barrier> barriers = schedule(accesses());
    numberRuns();
    const std::vector<size_t> starts = slices();
    const bool waits = !device.runsInOrder();
    sets.reset();
    for (size_t i = 0; i < starts.size(); ++i) {
        const Slice slice{starts[i], i + 1 < starts.size() ? starts[i + 1] : passes.size()};
        if (inFlight) finish(*inFlight);
        inFlight.reset();
        beginSubmission(static_cast<uint32_t>(slice.end - slice.first));
        for (size_t p = slice.first; p < slice.end; ++p) {
            if (waits && barriers[p].needed()) emitBarrier(commands, barriers[p]);
            progress.passReached(commands);
            record(passes[p]);
            timestamps.passDone(commands);
        }
        if (slice.end == passes.size() && barriers.back().needed()) emitBarrier(commands, barriers.back());
        submit(slice);
        inFlight = slice;
    }
}

void FrameGraph::State::requireIdle(const std::string& what) const {
    if (isSubmitted)
        fail(ExitCode::Internal, "{}: what was submitted before is to be waited for first", what);
}

// Whatever happened, the next frame starts with an empty graph.
void FrameGraph::State::clear() {
    passes.clear();
    whenExecuted.clear();
    list = nextList();
    cutNext = false;
    isSubmitted = false;
    inFlight.reset();
}

void FrameGraph::submit() {
    State& s = *state_;
    s.requireIdle("submit");
    try {
        if (!s.passes.empty()) s.submitAll();
    } catch (...) {
        s.clear();
        throw;
    }
    s.isSubmitted = true;
}

void FrameGraph::wait() {
    State& s = *state_;
    if (!s.isSubmitted) return;
    struct Clear {
        State& state;
        ~Clear() { state.clear(); }
    } clear{s};
    if (s.inFlight) s.finish(*s.inFlight);
    for (const auto& then : s.whenExecuted) then();
}

void FrameGraph::execute() {
    submit();
    wait();
}

} // namespace irradia
