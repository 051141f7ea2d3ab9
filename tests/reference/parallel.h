// Independent pieces of work over threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace irradia::reference {

// Calls work(i) for i in [0, count), each once, in any order. threads = 0: as many as the machine has.
template <typename Work>
void parallelFor(int count, int threads, const Work& work) {
    if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::atomic<int> next{0};
    const auto worker = [&] {
        for (int i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < std::min(threads, count); ++i) others.emplace_back(worker);
    worker();
}

} // namespace irradia::reference
