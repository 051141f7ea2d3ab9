// Wall-clock time of the same work on several threads.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <latch>
#include <sched.h>
#include <thread>
#include <vector>

namespace irradia {

// Keeps the calling thread on one of the processors that it may use: new threads share one for milliseconds
// before the system spreads them.
inline void stayOnProcessor(uint32_t index) {
    cpu_set_t usable, one;
    if (sched_getaffinity(0, sizeof(usable), &usable) != 0 || CPU_COUNT(&usable) == 0) return;
    uint32_t left = index % uint32_t(CPU_COUNT(&usable));
    for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
        if (!CPU_ISSET(processor, &usable) || left-- > 0) continue;
        CPU_ZERO(&one);
        CPU_SET(processor, &one);
        sched_setaffinity(0, sizeof(one), &one);
        return;
    }
}

// Calls work(0) ... work(threads - 1), each on a thread and a processor of its own and all started together.
// Returns the seconds from the first one's start to the last one's end.
template <typename Work>
double parallelTime(uint32_t threads, const Work& work) {
    using Clock = std::chrono::steady_clock;
    std::latch ready(threads);
    std::vector<Clock::time_point> starts(threads), ends(threads);
    {
        std::vector<std::jthread> workers;
        for (uint32_t i = 0; i < threads; ++i)
            workers.emplace_back([&, i] {
                stayOnProcessor(i);
                ready.arrive_and_wait();
                starts[i] = Clock::now();
                work(i);
                ends[i] = Clock::now();
            });
    }
    const auto elapsed =
        *std::max_element(ends.begin(), ends.end()) - *std::min_element(starts.begin(), starts.end());
    return std::chrono::duration<double>(elapsed).count();
}

} // namespace irradia
