// Wall-clock time of the same work on several threads.
#pragma once

#include <chrono>
#include <cstdint>
#include <latch>
#include <thread>
#include <vector>

namespace irradia {

// Calls work(0) ... work(threads - 1), each on its own thread and all started together. Returns the seconds
// from the start until the last one ended.
template <typename Work>
double parallelTime(uint32_t threads, const Work& work) {
    std::latch ready(threads);
    std::chrono::steady_clock::time_point start;
    {
        std::vector<std::jthread> helpers;
        for (uint32_t i = 1; i < threads; ++i)
            helpers.emplace_back([&, i] {
                ready.arrive_and_wait();
                work(i);
            });
        ready.arrive_and_wait();
        start = std::chrono::steady_clock::now();
        work(0u);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace irradia
