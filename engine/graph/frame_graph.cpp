// Declaring passes.
#include "engine/graph/frame_graph.h"
#include "engine/error.h"
#include "engine/graph/frame_graph_state.h"
#include <atomic>
#include <cstring>

namespace irradia {
namespace {

// Of an execution, but for those that follow until the next cut. Each has a descriptor set, for which
// lavapipe maps memory, and a process has 65,530 mappings.
constexpr size_t kMostPasses = 2048;

void checkTransfer(const char* verb, const BufferRange& range) {
    const Buffer& buffer = *range.buffer;
    if (range.bytes == 0 || range.offset % 4 != 0 || range.bytes % 4 != 0 || range.offset > buffer.bytes() ||
        range.bytes > buffer.bytes() - range.offset)
        fail(ExitCode::Internal, "{}: {} bytes at {} are not whole words in buffer {} ({} bytes)", verb,
             range.bytes, range.offset, buffer.name(), buffer.bytes());
}

} // namespace

uint64_t FrameGraph::State::nextList() {
    static std::atomic<uint64_t> last = 0;
    return ++last;
}

DeclaredPass& FrameGraph::State::add(const std::string& name) {
    requireIdle("pass " + name);
    if (!passes.empty() && passes.back().command == DeclaredPass::Command::None)
        fail(ExitCode::Internal, "pass {}: is declared but never dispatched", passes.back().name);
    DeclaredPass& pass = passes.emplace_back();
    pass.name = section.empty() ? name : section + "/" + name;
    pass.cutBefore = cutNext;
    cutNext = false;
    return pass;
}

void FrameGraph::State::end(size_t index) {
    DeclaredPass pass = std::move(passes.at(index));
    passes.resize(index); // a pass that is refused or has nothing to do is left out
    checkAgainstKernel(pass, device);
    const uint32_t most = device.limits().maxComputeWorkGroupCount[0];
    if (pass.groups > most)
        fail(ExitCode::Internal,
             "pass {}: {} workgroups of {} are more than the device's {}: dispatch parts, or enlarge the "
             "workgroups",
             pass.name, pass.groups, pass.kernel->workgroupSize(), most);
    if (pass.command == DeclaredPass::Command::Dispatch && pass.groups == 0)
        cutNext = pass.cutBefore;
    else
        passes.push_back(std::move(pass));
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
    DeclaredPass& pass = state_->add("fill");
    pass.command = DeclaredPass::Command::Fill;
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
    DeclaredPass& pass = state_->add("copy");
    pass.command = DeclaredPass::Command::Copy;
    pass.argument = from;
    pass.target = to;
}

void FrameGraph::updateBytes(BufferRange range, std::span<const std::byte> bytes) {
    checkTransfer("update", range);
    if (range.bytes != bytes.size())
        fail(ExitCode::Internal, "update: {} bytes of buffer {} from {}", range.bytes, range.buffer->name(),
             bytes.size());
    DeclaredPass& pass = state_->add("update");
    pass.command = DeclaredPass::Command::Update;
    pass.target = range;
    pass.content.assign(bytes.begin(), bytes.end());
}

void FrameGraph::section(const std::string& name) {
    state_->section = name;
}

void FrameGraph::cut() {
    if (state_->passes.size() >= kMostPasses)
        execute();
    else
        state_->cutNext = true;
}

void FrameGraph::whenExecuted(std::function<void()> then) {
    state_->whenExecuted.push_back(std::move(then));
}

uint64_t FrameGraph::list() const {
    return state_->list;
}

void FrameGraph::setTimeout(double seconds) {
    state_->timeoutSeconds = seconds;
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

Pass& Pass::bind(std::span<const PassBinding> bindings) {
    for (const PassBinding& binding : bindings) bind(binding.range, binding.read, binding.write);
    return *this;
}

Pass& Pass::bind(BufferRange range, bool read, bool write) {
    graph_.state_->passes[index_].bindings.push_back({range, read, write});
    return *this;
}

Pass& Pass::pushBytes(std::span<const std::byte> bytes) {
    DeclaredPass& pass = graph_.state_->passes[index_];
    std::memcpy(pass.push.data(), bytes.data(), bytes.size());
    pass.pushBytes = static_cast<uint32_t>(bytes.size());
    return *this;
}

void Pass::dispatch(uint64_t items) {
    const DeclaredPass& pass = graph_.state_->passes[index_];
    const uint64_t size = pass.kernel->workgroupSize();
    const uint64_t groups = items / size + (items % size != 0);
    if (groups > UINT32_MAX) fail(ExitCode::Internal, "pass {}: {} items are too many", pass.name, items);
    dispatchGroups(static_cast<uint32_t>(groups));
}

void Pass::dispatchGroups(uint32_t groups) {
    DeclaredPass& pass = graph_.state_->passes[index_];
    pass.command = DeclaredPass::Command::Dispatch;
    pass.groups = groups;
    graph_.state_->end(index_);
}

void Pass::dispatchIndirect(BufferRange arguments) {
    DeclaredPass& pass = graph_.state_->passes[index_];
    checkTransfer("dispatchIndirect", arguments);
    if (arguments.bytes < 3 * sizeof(uint32_t))
        fail(ExitCode::Internal, "pass {}: buffer {} holds no three group counts", pass.name,
             arguments.buffer->name());
    pass.command = DeclaredPass::Command::DispatchIndirect;
    pass.argument = arguments;
    graph_.state_->end(index_);
}

} // namespace irradia
