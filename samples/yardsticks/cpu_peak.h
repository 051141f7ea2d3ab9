// What this machine's cores can do at most: single-precision multiply-adds, and bytes copied.
#pragma once

#include <cstdint>
#include <string>

namespace irradia {

struct CpuPeak {
    double gflops = 0; // all threads together, a multiply-add counted as two
    std::string form;  // the instructions that reached it
};

// Best of every form that this CPU has (fused and separate multiply-add, 256 and 512 bits wide), each run for
// about `seconds` on `threads` threads at once.
CpuPeak measureCpuPeak(uint32_t threads, double seconds = 0.01);

// GB/s read and written (a byte copied counts twice) by copies between buffers far larger than the caches.
double measureCopyBandwidth(uint32_t threads);

} // namespace irradia
