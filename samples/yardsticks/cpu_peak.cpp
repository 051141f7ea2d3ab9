#include "samples/yardsticks/cpu_peak.h"
#include "samples/yardsticks/parallel_time.h"
#include <algorithm>
#include <atomic>
#include <cstring>
#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace irradia {
namespace {

// Independent sums: enough to cover 4 cycles of latency at two multiply-adds a cycle, few enough for
// registers.
constexpr uint32_t kSums = 12;

// A form runs `iterations` times over its sums and returns a value that depends on all of them.
struct Form {
    const char* name;
    float (*run)(uint64_t iterations);
    double flops; // of an iteration
    bool usable;
};

#ifdef __x86_64__

// x <- x * a + b with |a| < 1 neither overflows nor becomes denormal.
constexpr float kFactor = 0.999f;
constexpr float kTerm = 0.001f;

__attribute__((target("avx,fma"))) float fused256(uint64_t iterations) {
    const __m256 a = _mm256_set1_ps(kFactor), b = _mm256_set1_ps(kTerm);
    __m256 x[kSums];
    for (uint32_t i = 0; i < kSums; ++i) x[i] = _mm256_set1_ps(float(i));
    for (uint64_t n = 0; n < iterations; ++n)
#pragma GCC unroll 12
        for (uint32_t i = 0; i < kSums; ++i) x[i] = _mm256_fmadd_ps(x[i], a, b);
    for (uint32_t i = 1; i < kSums; ++i) x[0] = _mm256_add_ps(x[0], x[i]);
    return _mm256_cvtss_f32(x[0]);
}

__attribute__((target("avx512f"))) float fused512(uint64_t iterations) {
    const __m512 a = _mm512_set1_ps(kFactor), b = _mm512_set1_ps(kTerm);
    __m512 x[kSums];
    for (uint32_t i = 0; i < kSums; ++i) x[i] = _mm512_set1_ps(float(i));
    for (uint64_t n = 0; n < iterations; ++n)
#pragma GCC unroll 12
        for (uint32_t i = 0; i < kSums; ++i) x[i] = _mm512_fmadd_ps(x[i], a, b);
    for (uint32_t i = 1; i < kSums; ++i) x[0] = _mm512_add_ps(x[0], x[i]);
    return _mm512_cvtss_f32(x[0]);
}

// Without "fma" in the target the compiler cannot fuse the two.
__attribute__((target("avx"))) float separate256(uint64_t iterations) {
    const __m256 a = _mm256_set1_ps(kFactor), b = _mm256_set1_ps(kTerm);
    __m256 x[kSums];
    for (uint32_t i = 0; i < kSums; ++i) x[i] = _mm256_set1_ps(float(i));
    for (uint64_t n = 0; n < iterations; ++n)
#pragma GCC unroll 12
        for (uint32_t i = 0; i < kSums; ++i) x[i] = _mm256_add_ps(_mm256_mul_ps(x[i], a), b);
    for (uint32_t i = 1; i < kSums; ++i) x[0] = _mm256_add_ps(x[0], x[i]);
    return _mm256_cvtss_f32(x[0]);
}

std::vector<Form> forms() {
    const bool avx = __builtin_cpu_supports("avx");
    return {{"256-bit fused", fused256, 2.0 * 8 * kSums, avx && __builtin_cpu_supports("fma")},
            {"512-bit fused", fused512, 2.0 * 16 * kSums, __builtin_cpu_supports("avx512f") != 0},
            {"256-bit separate", separate256, 2.0 * 8 * kSums, avx}};
}

#else

using Vector = float __attribute__((vector_size(16)));

float generic128(uint64_t iterations) {
    const Vector a = Vector{} + 0.999f, b = Vector{} + 0.001f;
    Vector x[kSums];
    for (uint32_t i = 0; i < kSums; ++i) x[i] = Vector{} + float(i);
    for (uint64_t n = 0; n < iterations; ++n)
#pragma GCC unroll 12
        for (uint32_t i = 0; i < kSums; ++i) x[i] = x[i] * a + b;
    for (uint32_t i = 1; i < kSums; ++i) x[0] += x[i];
    return x[0][0];
}

std::vector<Form> forms() {
    return {{"128-bit", generic128, 2.0 * 4 * kSums, true}};
}

#endif

std::atomic<float> gSink; // so that no sum can be left out

double flopRate(const Form& form, uint32_t threads, double seconds) {
    const auto timed = [&](uint64_t iterations) {
        return parallelTime(threads, [&](uint32_t) { gSink = form.run(iterations); });
    };
    constexpr uint64_t kTrial = 1u << 16;
    const double trial = std::min(timed(kTrial), timed(kTrial));
    const auto iterations = std::max<uint64_t>(kTrial, uint64_t(double(kTrial) * seconds / trial));
    return form.flops * double(iterations) * threads / timed(iterations);
}

} // namespace

CpuPeak measureCpuPeak(uint32_t threads, double seconds) {
    CpuPeak best;
    for (const Form& form : forms()) {
        const double gflops = form.usable ? flopRate(form, threads, seconds) * 1e-9 : 0.0;
        if (gflops > best.gflops) best = {gflops, form.name};
    }
    return best;
}

double measureCopyBandwidth(uint32_t threads) {
    constexpr size_t kBytes = 64u << 20; // of a thread's source, and as many of its target
    constexpr int kCopies = 3;
    std::vector<std::vector<char>> from(threads, std::vector<char>(kBytes, 1));
    std::vector<std::vector<char>> to(threads, std::vector<char>(kBytes, 2));
    const double seconds = parallelTime(threads, [&](uint32_t thread) {
        for (int i = 0; i < kCopies; ++i) std::memcpy(to[thread].data(), from[thread].data(), kBytes);
    });
    return 2.0 * kCopies * kBytes * threads / seconds * 1e-9;
}

} // namespace irradia
