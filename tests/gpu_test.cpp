// The device layer and the frame graph on the real device, under validation.
#include "engine/error.h"
#include "engine/graph/frame_graph.h"
#include "kernels/shaders.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <glm/glm.hpp>
#include <numeric>

using namespace irradia;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;

using irradia::test::deviceWith;

namespace {

struct ScaleParams {
    uint32_t count;
    uint32_t factor;
};

std::vector<glm::uvec4> ramp(uint32_t count) {
    std::vector<glm::uvec4> values;
    for (uint32_t i = 0; i < count; ++i) values.emplace_back(i, i + 1, i * i, ~i);
    return values;
}

template <typename Action>
void requireRefusal(ExitCode code, const std::string& sentence, Action&& action) {
    try {
        action();
    } catch (const Error& error) {
        CHECK(error.code() == code);
        CHECK_THAT(error.what(), ContainsSubstring(sentence));
        return;
    }
    FAIL("not refused: " << sentence);
}

const QuadAccess kForms[] = {QuadAccess::Texel, QuadAccess::Storage};

} // namespace

TEST_CASE("buffers start as zero and keep what is uploaded, at any offset") {
    Device& device = deviceWith(QuadAccess::Texel);
    Buffer buffer(device, "bytes", 1001);
    const std::vector<uint8_t> zeros(1001, 0);
    REQUIRE(download<uint8_t>(device, buffer, 1001) == zeros);

    std::vector<uint8_t> values(500);
    std::iota(values.begin(), values.end(), uint8_t{1});
    upload<uint8_t>(device, buffer, values, 501);
    CHECK(download<uint8_t>(device, buffer, 500, 501) == values);
    CHECK(download<uint8_t>(device, buffer, 501) == std::vector<uint8_t>(501, 0));
    requireRefusal(ExitCode::Internal, "buffer bytes: upload of 500 bytes at 502 in 1001",
                   [&] { upload<uint8_t>(device, buffer, values, 502); });

    // More than one piece of the staging buffer.
    std::vector<uint32_t> many((33u << 20) / 4);
    for (uint32_t i = 0; i < many.size(); ++i) many[i] = i * 2654435761u;
    const Buffer large = makeBuffer(device, "large", many);
    CHECK(download<uint32_t>(device, large, many.size()) == many);
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("a kernel computes the same through texel views and through storage buffers") {
    for (const QuadAccess form : kForms) {
        Device& device = deviceWith(form);
        REQUIRE(device.texelQuads() == (form == QuadAccess::Texel));
        const Kernel scale(device, kernels::gpu_scale, {.constants = {{2, 5}}});
        CHECK(scale.bindings().at(0).type == (form == QuadAccess::Texel
                                                  ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                                  : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER));
        const std::vector<glm::uvec4> values = ramp(1000); // no multiple of a workgroup
        const Buffer source = makeBuffer(device, "source", values);
        const Buffer target(device, "target", 1001 * sizeof(glm::uvec4));
        FrameGraph graph(device);
        graph.pass(scale).read(source).write(target).push(ScaleParams{1000, 3}).dispatch(1000);
        graph.execute();
        const auto results = download<glm::uvec4>(device, target, 1001);
        for (uint32_t i = 0; i < 1000; ++i) REQUIRE(results[i] == values[i] * 3u + 5u);
        CHECK(results[1000] == glm::uvec4(0));
        CHECK(device.validationMessages() == 0);
    }
}

TEST_CASE("workgroup and subgroup have the sizes that kernels are told") {
    Device& device = deviceWith(QuadAccess::Texel);
    for (const uint32_t workgroup : {0u, 64u, 256u}) {
        if (device.canPinSubgroupSize() && workgroup > device.maxPinnedWorkgroup()) continue; // 4 lanes: 128
        const Kernel sizes(device, kernels::gpu_sizes, {.workgroupSize = workgroup});
        const Buffer buffer(device, "sizes", 16);
        FrameGraph graph(device);
        graph.pass(sizes).write(buffer).dispatch(1);
        graph.execute();
        const auto words = download<uint32_t>(device, buffer, 4);
        CHECK(words[0] == sizes.workgroupSize());
        CHECK(words[0] == (workgroup ? workgroup : (device.isCpu() ? 32u : 128u)));
        CHECK(words[1] == device.subgroupSize());
        CHECK(words[2] == device.subgroupSize());
        CHECK(words[3] == words[0] / device.subgroupSize());
    }
    CHECK(device.validationMessages() == 0);
}

// Without validation lavapipe gets no barriers.
TEST_CASE("passes that depend on each other run in order") {
    Device plain;
    CHECK_FALSE(deviceWith(QuadAccess::Texel).runsInOrder());
    for (Device* each : {&deviceWith(QuadAccess::Texel), &deviceWith(QuadAccess::Storage), &plain}) {
        Device& device = *each;
        const Kernel scale(device, kernels::gpu_scale, {.constants = {{2, 1}}});
        constexpr uint32_t kCount = 50000;
        const Buffer a = makeBuffer(device, "a", std::vector<glm::uvec4>(kCount, glm::uvec4(1)));
        const Buffer b(device, "b", a.bytes());
        const Buffer c(device, "c", a.bytes());
        FrameGraph graph(device);
        uint32_t expected = 1;
        for (int i = 0; i < 20;
             ++i) { // a -> b -> a ...: a write after a read and a read after a write each time
            graph.pass(scale)
                .read(i % 2 ? b : a)
                .write(i % 2 ? a : b)
                .push(ScaleParams{kCount, 2})
                .dispatch(kCount);
            expected = expected * 2 + 1;
        }
        graph.copy(a, c);
        graph.fill({a, 0, a.bytes() / 2}, 9);
        graph.execute();
        CHECK(download<glm::uvec4>(device, c, kCount) ==
              std::vector<glm::uvec4>(kCount, glm::uvec4(expected)));
        const auto filled = download<glm::uvec4>(device, a, kCount);
        CHECK(filled[kCount / 2 - 1] == glm::uvec4(9));
        CHECK(filled[kCount / 2] == glm::uvec4(expected));
        CHECK(device.validationMessages() == 0);
    }
}

TEST_CASE("what waits for an execution is called after it, in order, and never without") {
    Device& device = deviceWith(QuadAccess::Texel);
    const Kernel sizes(device, kernels::gpu_sizes);
    const Buffer buffer(device, "sizes", 16);
    std::vector<int> called;
    FrameGraph graph(device);
    const uint64_t list = graph.list();
    graph.pass(sizes).write(buffer).dispatch(1);
    graph.whenExecuted([&] { called.push_back(1); });
    graph.whenExecuted([&] { called.push_back(2); });
    CHECK(called.empty());
    graph.execute();
    CHECK(called == std::vector{1, 2});
    CHECK(graph.list() != list);
    graph.execute();
    CHECK(called.size() == 2);
    graph.whenExecuted([&] { called.push_back(3); });
    graph.execute(); // of no passes
    CHECK(called.size() == 3);

    const uint64_t failed = graph.list();
    graph.whenExecuted([&] { called.push_back(4); });
    graph.pass(sizes).write(buffer); // never dispatched
    CHECK_THROWS_AS(graph.execute(), Error);
    graph.execute();
    CHECK(called.size() == 3);
    CHECK(graph.list() != failed);
    {
        FrameGraph dropped(device);
        CHECK(dropped.list() != graph.list());
        dropped.whenExecuted([&] { called.push_back(5); });
    }
    CHECK(called.size() == 3);
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("between submit and wait the host does other work, and the results are those of execute") {
    Device& device = deviceWith(QuadAccess::Texel);
    constexpr uint32_t kCount = 1000;
    const Kernel scale(device, kernels::gpu_scale);
    const std::vector<glm::uvec4> values = ramp(kCount);
    const Buffer input = makeBuffer(device, "input", values);
    const auto declare = [&](FrameGraph& graph, const Buffer& a, const Buffer& b) {
        graph.pass(scale).read(input).write(a).push(ScaleParams{kCount, 3}).dispatch(kCount);
        graph.cut(); // never ran: a slice each
        graph.pass(scale).read(a).write(b).push(ScaleParams{kCount, 5}).dispatch(kCount);
    };
    const auto make = [&](const char* name) { return Buffer(device, name, kCount * sizeof(glm::uvec4)); };
    const Buffer a = make("a"), b = make("b"), c = make("c"), d = make("d");
    FrameGraph expected(device);
    declare(expected, c, d);
    expected.execute();

    FrameGraph graph(device);
    bool isCalled = false;
    for (int frame = 0; frame < 3; ++frame) {
        declare(graph, a, b);
        graph.whenExecuted([&] { isCalled = true; });
        isCalled = false;
        graph.submit();
        CHECK(!isCalled);
        // Another graph, and transfers, while it is in flight.
        FrameGraph other(device);
        declare(other, c, d);
        other.execute();
        CHECK(download<glm::uvec4>(device, input, kCount) == values);
        requireRefusal(ExitCode::Internal, "to be waited for first", [&] { graph.submit(); });
        requireRefusal(ExitCode::Internal, "to be waited for first", [&] { graph.fill(a, 0); });
        graph.wait();
        CHECK(isCalled);
        CHECK(download<glm::uvec4>(device, b, kCount) == download<glm::uvec4>(device, d, kCount));
        graph.wait(); // nothing to wait for
    }
    {
        FrameGraph dropped(device);
        declare(dropped, a, b);
        dropped.submit();
    }
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("an indirect dispatch runs the group counts that an earlier pass wrote") {
    Device& device = deviceWith(QuadAccess::Texel);
    const Kernel count(device, kernels::gpu_count, {.workgroupSize = 32});
    const Buffer first(device, "first", 16);
    const Buffer second(device, "second", 16);
    const Buffer arguments(device, "arguments", 32);
    const Buffer ignored(device, "ignored", 12);
    FrameGraph graph(device);
    const uint32_t all = UINT32_MAX;
    graph.pass(count).readWrite(first).readWrite({arguments, 16, 16}).push(uint32_t{1000}).dispatch(1000);
    graph.pass(count, "indirect")
        .readWrite(second)
        .readWrite(ignored)
        .push(all)
        .dispatchIndirect({arguments, 16, 12});
    graph.execute();
    CHECK(download<uint32_t>(device, first, 1)[0] == 1000);
    CHECK(download<uint32_t>(device, arguments, 3, 16) == std::vector<uint32_t>{32, 1, 1}); // ceil(1000 / 32)
    CHECK(download<uint32_t>(device, second, 1)[0] == 32 * 32);
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("mapped buffers carry words to the device and back") {
    Device& device = deviceWith(QuadAccess::Texel);
    const Kernel count(device, kernels::gpu_count, {});
    const Buffer counters(device, "counters", 16, Memory::Host);
    const Buffer arguments(device, "arguments", 12);
    FrameGraph graph(device);
    for (uint32_t frame = 1; frame <= 3; ++frame) {
        const auto words = reinterpret_cast<uint32_t*>(counters.mapped().data());
        words[0] += 1000;
        graph.pass(count).readWrite(counters).readWrite(arguments).push(uint32_t{10}).dispatch(10);
        graph.execute();
        CHECK(words[0] == frame * 1010);
    }
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("reads outside of a binding give zero") {
    for (const QuadAccess form : kForms) {
        Device& device = deviceWith(form);
        const Kernel read(device, kernels::gpu_read_outside, {});
        const Buffer ones = makeBuffer(device, "ones", std::vector<uint32_t>(4096, 1));
        for (const uint32_t index : {64u, 1u << 20, 0x7fffffffu}) {
            const Buffer results(device, "results", 48);
            const BufferRange part(ones, 0, 256); // of the buffer's 16384: the rest must not be seen
            FrameGraph graph(device);
            graph.pass(read)
                .read({ones, 0, 256})
                .read(part)
                .read(part)
                .read(part)
                .write(results)
                .push(index)
                .dispatch(1);
            graph.execute();
            const auto values = download<glm::uvec4>(device, results, 3);
            CHECK(values[0] == glm::uvec4(0));
            CHECK(values[1] == glm::uvec4(0, 0, 0, 7));
            CHECK(values[2] == glm::uvec4(0));
        }
        CHECK(device.validationMessages() == 0);
    }
}

TEST_CASE("a pass that does not fit its kernel is refused by name") {
    Device& device = deviceWith(QuadAccess::Texel);
    const Kernel scale(device, kernels::gpu_scale, {});
    const Kernel spin(device, kernels::gpu_spin, {});
    const Buffer a(device, "a", 160);
    const Buffer b(device, "b", 160);
    FrameGraph graph(device);
    const ScaleParams params{10, 1};
    const auto refused = [&](const std::string& sentence, auto&& action) {
        requireRefusal(ExitCode::Internal, sentence, action);
    };
    refused("pass gpu_scale: 1 buffers are bound, kernel gpu_scale has 2 bindings",
            [&] { graph.pass(scale).read(a).push(params).dispatch(10); });
    refused("binding 1 (target) is bound for read, the kernel declares write",
            [&] { graph.pass(scale).read(a).read(b).push(params).dispatch(10); });
    refused("binding 0 (source) is bound for readWrite, the kernel declares read",
            [&] { graph.pass(scale).readWrite(a).write(b).push(params).dispatch(10); });
    refused("4 bytes of push constants are given, kernel gpu_scale declares 8",
            [&] { graph.pass(scale).read(a).write(b).push(uint32_t{1}).dispatch(10); });
    refused("0 bytes of push constants are given", [&] { graph.pass(scale).read(a).write(b).dispatch(10); });
    refused("target: 320 bytes at 0 are not a range of buffer b (160 bytes)", [&] {
        graph.pass(scale).read(a).write({b, 0, 320}).push(params).dispatch(10);
    });
    refused("target: 24 bytes of buffer b are not whole texels of 16", [&] {
        graph.pass(scale).read(a).write({b, 0, 24}).push(params).dispatch(10);
    });
    refused("target: offset 4 in buffer b is not a multiple of", [&] {
        graph.pass(scale).read(a).write({b, 4, 16}).push(params).dispatch(10);
    });
    refused("more than the device's", [&] {
        graph.pass(scale).read(a).write(b).push(params).dispatch(uint64_t{UINT32_MAX} *
                                                                 scale.workgroupSize());
    });
    refused("fill: 6 bytes at 0 are not whole words in buffer a", [&] { graph.fill({a, 0, 6}, 0); });
    refused("copy: the ranges overlap in buffer a", [&] { graph.copy({a, 0, 32}, {a, 16, 32}); });
    refused("pass both: writes bytes of buffer a", [&] {
        graph.pass(scale, "both").read(a).write(a).push(params).dispatch(10);
        graph.execute();
    });
    refused("pass gpu_spin: is declared but never dispatched", [&] {
        static_cast<void>(graph.pass(spin));
        graph.execute();
    });
    graph.pass(scale).read(a).write(b).push(params).dispatch(0); // nothing to do
    graph.execute();
    refused("kernel gpu_scale: has no specialisation constant 3", [&] {
        Kernel(device, kernels::gpu_scale, {.constants = {{3, 1}}});
    });
    refused("kernel gpu_scale: workgroups of 100000 are more than the device's",
            [&] { Kernel(device, kernels::gpu_scale, {.workgroupSize = 100000}); });
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("a whole buffer beyond the limit of storage bindings is refused where it is bound") {
    Device& device = deviceWith(QuadAccess::Storage);
    const uint64_t bytes = uint64_t{device.limits().maxStorageBufferRange} + 16;
    if (bytes > (256ull << 20)) SKIP("this device binds " << bytes - 16 << " bytes at once");
    const Kernel scale(device, kernels::gpu_scale, {});
    const Buffer large(device, "large", bytes);
    const Buffer target(device, "target", 16);
    FrameGraph graph(device);
    requireRefusal(ExitCode::Internal, "bytes of buffer large are more than one binding holds", [&] {
        graph.pass(scale).read(large).write(target).push(ScaleParams{1, 1}).dispatch(1);
    });
}

TEST_CASE("memory beyond the budget is refused, planned or not, and counted while it is held") {
    Device& device = deviceWith(QuadAccess::Texel);
    const uint64_t before = device.memoryUsed();
    const uint64_t budget = device.memoryBudget();
    CHECK(budget > 0);
    CHECK(budget < device.description().memoryBytes);
    device.plan({{"small", 1u << 20}, {"other", 1u << 10}});
    requireRefusal(ExitCode::OutOfMemory, "more than the budget of", [&] {
        device.plan({{"half", budget / 2}, {"rest", budget / 2 + (1u << 20)}});
    });
    requireRefusal(ExitCode::OutOfMemory,
                   "buffer all: ", [&] { Buffer(device, "all", budget + (1u << 20)); });
    CHECK(device.memoryUsed() == before);
    {
        Buffer held(device, "held", 1u << 20);
        CHECK(device.memoryUsed() >= before + (1u << 20));
        Buffer moved = std::move(held);
        CHECK(device.memoryUsed() >= before + (1u << 20));
    }
    CHECK(device.memoryUsed() == before);
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("devices are chosen by index, part of the name or type") {
    const std::vector<DeviceDescription> devices = listDevices();
    REQUIRE(!devices.empty());
    const DeviceDescription& own = deviceWith(QuadAccess::Texel).description();
    CHECK(Device({.select = std::to_string(own.index)}).description().name == own.name);
    CHECK(Device({.select = own.name.substr(1, 6)}).description().name == own.name);
    if (own.type == "cpu") CHECK(Device({.select = "cpu"}).isCpu());
    requireRefusal(ExitCode::NoDevice, "no device matches 'abacus'; there are: 0 ",
                   [] { Device({.select = "abacus"}); });
    requireRefusal(ExitCode::NoDevice, "no device matches '99'", [] { Device({.select = "99"}); });
    requireRefusal(ExitCode::NoDevice, "subgroups of", [] { Device({.subgroupSize = 3}); });
    CHECK(Device({.subgroupSize = own.subgroupSize}).subgroupSize() == own.subgroupSize);
}

TEST_CASE("the profiler has a row for each pass, and slices change no result") {
    Device& device = deviceWith(QuadAccess::Texel);
    const Kernel spin(device, kernels::gpu_spin, {});
    std::vector<std::vector<uint32_t>> results;
    for (const bool cuts : {false, true}) {
        Profiler profiler;
        FrameGraph graph(device, &profiler);
        const Buffer state(device, "state", 1024 * 4);
        for (int frame = 0; frame < 2; ++frame) {
            for (int i = 0; i < 4; ++i) {
                graph.pass(spin, i == 0 ? "first" : "later")
                    .readWrite(state)
                    .push(uint32_t{1000})
                    .dispatch(1024);
                if (cuts) graph.cut();
            }
            graph.execute();
            profiler.endFrame(1.0);
        }
        results.push_back(download<uint32_t>(device, state, 1024));
        if (device.timestampPeriodNs() <= 0) continue;
        const std::vector<Profiler::Row> rows = profiler.rows();
        REQUIRE(rows.size() == 2);
        CHECK(rows[0].name == "first");
        CHECK(rows[0].runs == 2);
        CHECK(rows[1].name == "later");
        CHECK(rows[1].runs == 6);
        CHECK(rows[1].p50 > 0);
    }
    CHECK(results[0] == results[1]);
    CHECK(device.validationMessages() == 0);
}

TEST_CASE("a submission that takes too long is given up, and the pass at work named") {
    // A device of its own: nothing of it can be used or freed afterwards.
    Device device({.validation = true});
    const Kernel spin(device, kernels::gpu_spin, {});
    const Buffer state(device, "state", 1024 * 4);
    FrameGraph graph(device);
    graph.pass(spin, "compiles").readWrite(state).push(uint32_t{1}).dispatch(1024);
    graph.execute();
    graph.setTimeout(0.2);
    graph.pass(spin, "short").readWrite(state).push(uint32_t{1}).dispatch(1024);
    graph.pass(spin, "long")
        .readWrite(state)
        .push(device.isCpu() ? 50'000'000u : 4'000'000'000u)
        .dispatch(1024);
    graph.pass(spin, "never").readWrite(state).push(uint32_t{1}).dispatch(1024);
    requireRefusal(ExitCode::Internal, "did not finish within 0.2 s; the last pass was long",
                   [&] { graph.execute(); });
    CHECK(device.abandoned());
}

TEST_CASE("validation messages are counted") {
    Device device({.validation = true});
    REQUIRE(device.validationMessages() == 0);
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO}; // of no bytes and no usage
    VkBuffer buffer = VK_NULL_HANDLE;
    if (vkCreateBuffer(device.handle(), &info, nullptr, &buffer) == VK_SUCCESS)
        vkDestroyBuffer(device.handle(), buffer, nullptr);
    CHECK(device.validationMessages() > 0);
}
