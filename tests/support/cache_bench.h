// What the suites of the cache's kernels share: random rows and training paths, and a device with the cache's
// small buffers.
#pragma once

#include "engine/gpu/kernel.h"
#include "tests/reference/random.h"
#include "tests/support/cache_buffers.h"
#include "tests/support/validated_device.h"

namespace irradia::test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBadRadiance[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e30};

// Of a few products, a division and a sum: each rounds by 6e-8, the division by three times as much.
constexpr double kRounding = 1e-6;

// Single precision, as the buffers hold it.
inline double stored(double x) {
    return static_cast<float>(x);
}

reference::Vec3 randomColour(reference::Random& random, double low = 0.0, double high = 1.0);

// Some reflectances are below the limit under which a channel is not learned, some are 0.
reference::Values randomInputs(reference::Random& random);

// Paths of 0 to 8 vertices, half of them ended in the cache.
std::vector<reference::TrainingPath> randomPaths(reference::Random& random, size_t count);

// Largest difference of channels relative to `size`; infinite where only one is a number.
double difference(const reference::Vec3& actual, const reference::Vec3& expected, double size);

gpu::CacheState stateOf(double scale);

class CacheBench {
public:
    explicit CacheBench(QuadAccess form);

    Buffer make(const Quads& quads) { return makeBuffer(device, "quads", quads); }
    void set(uint32_t counter, uint32_t value);
    uint32_t counter(uint32_t counter) const;
    void set(const gpu::CacheState& value);
    gpu::CacheState readState() const;

    // Made once: compiling takes longer than running.
    const Kernel& kernel(const KernelSource& source);

    Device& device;
    Buffer counters, state;
};

} // namespace irradia::test
