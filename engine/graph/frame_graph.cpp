#include "engine/graph/frame_graph.h"
#include "engine/error.h"
#include "engine/gpu/commands.h"
#include "engine/graph/barrier.h"
#include "engine/graph/descriptor_sets.h"
#include "engine/graph/progress.h"
#include "engine/graph/slices.h"
#include "engine/graph/timestamps.h"
#include <bit>
#include <cstring>
#include <map>
#include <set>

namespace irradia {
namespace {

constexpr double kSliceMilliseconds = 100;

void checkTransfer(const char* verb, const BufferRange& range) {
    const Buffer& buffer = *range.buffer;
    if (range.bytes == 0 || range.offset % 4 != 0 || range.bytes % 4 != 0 || range.offset > buffer.bytes() ||
        range.bytes > buffer.bytes() - range.offset)
        fail(ExitCode::Internal, "{}: {} bytes at {} are not whole words in buffer {} ({} bytes)", verb,
             range.bytes, range.offset, buffer.name(), buffer.bytes());
}

} // namespace

struct FrameGraph::State {
    State(Device& d, Profiler* p)
        : device(d)
        , profiler(p)
        , sets(d)
        , timestamps(d)
        , progress(d) {}
    ~State();

    PassRecord& add(const std::string& name);
    void end(size_t index); // the pass is complete: checks it
    std::vector<ScheduledPass> accesses() const;
    std::vector<size_t> slices() const;
    void record(const PassRecord& pass);
    void beginSubmission(uint32_t passCount);
    void submit(size_t first, size_t end);
    void keepTimes(size_t first);

    Device& device;
    Profiler* profiler;
    double timeoutSeconds = 60;
    std::vector<PassRecord> passes;
    bool cutNext = false;
    DescriptorSets sets;
    Timestamps timestamps;
    Progress progress;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
    std::map<std::string, double, std::less<>> lastTimes; // ms of the last run of a pass of that name
};

FrameGraph::State::~State() {
    if (!device.abandoned()) vkDestroyCommandPool(device.handle(), pool, nullptr);
}

PassRecord& FrameGraph::State::add(const std::string& name) {
    if (!passes.empty() && passes.back().command == PassRecord::Command::None)
        fail(ExitCode::Internal, "pass {}: is declared but never dispatched", passes.back().name);
    PassRecord& pass = passes.emplace_back();
    pass.name = name;
    pass.cutBefore = cutNext;
    cutNext = false;
    return pass;
}

void FrameGraph::State::end(size_t index) {
    PassRecord pass = std::move(passes.at(index));
    passes.resize(index); // a pass that is refused or has nothing to do is left out
    checkAgainstKernel(pass, device);
    const uint32_t most = device.limits().maxComputeWorkGroupCount[0];
    if (pass.groups > most)
        fail(ExitCode::Internal,
             "pass {}: {} workgroups of {} are more than the device's {}: dispatch parts, or enlarge the "
             "workgroups",
             pass.name, pass.groups, pass.kernel->workgroupSize(), most);
    if (pass.command == PassRecord::Command::Dispatch && pass.groups == 0)
        cutNext = pass.cutBefore;
    else
        passes.push_back(std::move(pass));
}

// The passes' accesses, and the host's, which reads mapped buffers when all is done.
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
                                 AccessKind::Host, true, true, buffer->name()});
    scheduled.push_back(host);
    return scheduled;
}

// A pass that never ran counts as a whole slice.
std::vector<size_t> FrameGraph::State::slices() const {
    std::vector<SliceCandidate> candidates;
    for (const PassRecord& pass : passes) {
        const auto last = lastTimes.find(pass.name);
        candidates.push_back({last == lastTimes.end() ? kSliceMilliseconds : last->second, pass.cutBefore});
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

void FrameGraph::State::submit(size_t first, size_t end) {
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    try {
        device.submitAndWait(commands, passes[first].name + " to " + passes[end - 1].name, timeoutSeconds);
    } catch (const Error& error) {
        fail(error.code(), "{}; the last pass was {}", error.what(),
             passes[first + progress.lastReached()].name);
    }
}

void FrameGraph::State::keepTimes(size_t first) {
    const std::vector<double> times = timestamps.milliseconds();
    for (size_t i = 0; i < times.size(); ++i) {
        const PassRecord& pass = passes[first + i];
        lastTimes.insert_or_assign(pass.name, times[i]);
        if (profiler) profiler->record(pass.name, times[i]);
    }
}

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
    s.beginLabel = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(device.instance(), "vkCmdBeginDebugUtilsLabelEXT"));
    s.endLabel = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(device.instance(), "vkCmdEndDebugUtilsLabelEXT"));
}

FrameGraph::~FrameGraph() = default;

Pass FrameGraph::pass(const Kernel& kernel) {
    return pass(kernel, kernel.name());
}

Pass FrameGraph::pass(const Kernel& kernel, const std::string& name) {
    state_->add(name).kernel = &kernel;
    return Pass(*this, state_->passes.size() - 1);
}

void FrameGraph::fill(BufferRange range, uint32_t value) {
    checkTransfer("fill", range);
    PassRecord& pass = state_->add("fill");
    pass.command = PassRecord::Command::Fill;
    pass.target = range;
    pass.value = value;
}

void FrameGraph::copy(BufferRange from, BufferRange to) {
    checkTransfer("copy", from);
    checkTransfer("copy", to);
    if (from.bytes != to.bytes)
        fail(ExitCode::Internal, "copy: {} bytes of buffer {} to {} bytes of buffer {}", from.bytes,
             from.buffer->name(), to.bytes, to.buffer->name());
    if (from.buffer == to.buffer && from.offset < to.offset + to.bytes &&
        to.offset < from.offset + from.bytes)
        fail(ExitCode::Internal, "copy: the ranges overlap in buffer {}", from.buffer->name());
    PassRecord& pass = state_->add("copy");
    pass.command = PassRecord::Command::Copy;
    pass.argument = from;
    pass.target = to;
}

void FrameGraph::cut() {
    state_->cutNext = true;
}
void FrameGraph::setTimeout(double seconds) {
    state_->timeoutSeconds = seconds;
}

void FrameGraph::execute() {
    State& s = *state_;
    // Whatever happens, the next frame starts with an empty graph.
    struct Clear {
        State& state;
        ~Clear() {
            state.passes.clear();
            state.cutNext = false;
        }
    } clear{s};
    if (s.passes.empty()) return;
    if (s.passes.back().command == PassRecord::Command::None)
        fail(ExitCode::Internal, "pass {}: is declared but never dispatched", s.passes.back().name);

    const std::vector<Barrier> barriers = schedule(s.accesses());
    const std::vector<size_t> starts = s.slices();
    s.sets.reset(s.passes);
    for (size_t slice = 0; slice < starts.size(); ++slice) {
        const size_t first = starts[slice];
        const size_t end = slice + 1 < starts.size() ? starts[slice + 1] : s.passes.size();
        s.beginSubmission(static_cast<uint32_t>(end - first));
        for (size_t i = first; i < end; ++i) {
            if (barriers[i].needed()) emitBarrier(s.commands, barriers[i]);
            s.progress.passReached(s.commands);
            s.record(s.passes[i]);
            s.timestamps.passDone(s.commands);
        }
        if (end == s.passes.size() && barriers.back().needed()) emitBarrier(s.commands, barriers.back());
        s.submit(first, end);
        s.keepTimes(first);
    }
}

Pass& Pass::read(BufferRange range) {
    return bind(range, true, false);
}
Pass& Pass::write(BufferRange range) {
    return bind(range, false, true);
}
Pass& Pass::readWrite(BufferRange range) {
    return bind(range, true, true);
}

Pass& Pass::bind(BufferRange range, bool read, bool write) {
    graph_.state_->passes[index_].bindings.push_back({range, read, write});
    return *this;
}

Pass& Pass::pushBytes(std::span<const std::byte> bytes) {
    PassRecord& pass = graph_.state_->passes[index_];
    std::memcpy(pass.push.data(), bytes.data(), bytes.size());
    pass.pushBytes = static_cast<uint32_t>(bytes.size());
    return *this;
}

void Pass::dispatch(uint64_t items) {
    const PassRecord& pass = graph_.state_->passes[index_];
    const uint64_t size = pass.kernel->workgroupSize();
    const uint64_t groups = items / size + (items % size != 0);
    if (groups > UINT32_MAX) fail(ExitCode::Internal, "pass {}: {} items are too many", pass.name, items);
    dispatchGroups(static_cast<uint32_t>(groups));
}

void Pass::dispatchGroups(uint32_t groups) {
    PassRecord& pass = graph_.state_->passes[index_];
    pass.command = PassRecord::Command::Dispatch;
    pass.groups = groups;
    graph_.state_->end(index_);
}

void Pass::dispatchIndirect(BufferRange arguments) {
    PassRecord& pass = graph_.state_->passes[index_];
    checkTransfer("dispatchIndirect", arguments);
    if (arguments.bytes < 3 * sizeof(uint32_t))
        fail(ExitCode::Internal, "pass {}: buffer {} holds no three group counts", pass.name,
             arguments.buffer->name());
    pass.command = PassRecord::Command::DispatchIndirect;
    pass.argument = arguments;
    graph_.state_->end(index_);
}

} // namespace irradia
