// A frame as a list of passes that bind buffers to kernels. Binding declares the access; schedule() derives
// the barriers. Nothing is reordered.
//
//     graph.pass(scatter).read(rays).read(hits).readWrite(radiance).write(nextRays).push(params).dispatch(count);
//
// Bindings are numbered by the order of the read/write calls, and checked against the kernel's own: count,
// and exactly the accesses its declaration allows (readonly, writeonly, or both).
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/kernel.h"
#include "engine/gpu/profiler.h"
#include "engine/graph/schedule.h"
#include <functional>
#include <memory>
#include <span>

namespace irradia {

class FrameGraph;

struct PassBinding {
    BufferRange range;
    bool read = false;
    bool write = false;
};

class Pass {
public:
    Pass& bind(std::span<const PassBinding> bindings); // one after the other
    Pass& read(BufferRange range);
    Pass& write(BufferRange range);
    Pass& readWrite(BufferRange range);
    template <typename T>
    Pass& push(const T& params) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 128);
        return pushBytes(std::as_bytes(std::span<const T, 1>(&params, 1)));
    }

    // Each of these ends the pass; one of no groups is left out. `items` invocations, rounded up to whole
    // workgroups: the kernel guards the rest.
    void dispatch(uint64_t items);
    void dispatchGroups(uint32_t groups);
    // Group counts from three uint32 at `arguments`.
    void dispatchIndirect(BufferRange arguments);

private:
    friend class FrameGraph;
    Pass(FrameGraph& graph, size_t index)
        : graph_(graph)
        , index_(index) {}
    Pass& bind(BufferRange range, bool read, bool write);
    Pass& pushBytes(std::span<const std::byte> bytes);
    FrameGraph& graph_;
    size_t index_;
};

class FrameGraph {
public:
    explicit FrameGraph(Device& device, Profiler* profiler = nullptr);
    ~FrameGraph();

    Pass pass(const Kernel& kernel);                          // named as the kernel
    Pass pass(const Kernel& kernel, const std::string& name); // a second use under its own row
    void fill(BufferRange range, uint32_t value);
    void copy(BufferRange from, BufferRange to);
    // Writes what `value` is now: a few constants, 64 KiB at most.
    template <typename T>
    void update(BufferRange range, const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0 && sizeof(T) <= 65536);
        updateBytes(range, std::as_bytes(std::span<const T, 1>(&value, 1)));
    }

    // What passes that follow belong to: their names become "NAME/PASS"; empty = nothing.
    void section(const std::string& name);

    // A place where a slice may end. submit() submits as many passes as took about 100 ms when they last ran
    // (which changes no result) and waits for each submission but the last, so that no watchdog sees a long
    // one. Once so
    // many passes are declared as one execution may hold, cut() executes them: however much a frame is, what
    // belongs to its passes stays bounded.
    void cut();

    // How long one submission may take before execute() gives the device up: 60 s; on a CPU 600 s, which
    // others may keep busy while it compiles.
    void setTimeout(double seconds);

    // Records and submits all passes. Of a list that is cut into slices the last alone may still be at work
    // when it returns, so that at most about 100 ms are left for the host to use. Until wait() kernels and
    // buffers must live, and nothing may be declared or submitted: both are refused. Other graphs, uploads
    // and downloads may be used, and come after what was submitted.
    void submit();
    // Until what was submitted is done; returns at once where nothing was. Then the graph is empty again,
    // whether or not it, or submit(), throws.
    void wait();
    void execute(); // submit() and wait()

    // For who keeps on the host what a buffer holds: `then` is called once all passes declared so far have
    // been executed, by wait() or cut(), and never if they are not (the graph is dropped, or one of these
    // throws).
    void whenExecuted(std::function<void()> then);
    // The number of the list of passes that is being declared: each execution begins another one, and no two
    // lists of a process have the same.
    uint64_t list() const;

private:
    friend class Pass;
    void updateBytes(BufferRange range, std::span<const std::byte> bytes);
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace irradia
