#include "tests/support/cache_bench.h"

#include <map>

namespace irradia::test {

using reference::Random;
using reference::TrainingPath;
using reference::Values;
using reference::Vec3;

Vec3 randomColour(Random& random, double low, double high) {
    Vec3 colour;
    for (int c = 0; c < 3; ++c) colour[c] = stored(low + (high - low) * random.uniform());
    return colour;
}

Values randomInputs(Random& random) {
    Values inputs;
    for (uint32_t i = 0; i < gpu::kCacheInputs; ++i) inputs.push_back(stored(random.uniform()));
    for (size_t c = 8; c < 11; ++c) {
        if (random.uniform() > 0.25) continue;
        inputs[c] = stored(1e-3 * random.uniform());
        inputs[c + 3] = random.uniform() < 0.3 ? inputs[c] = 0.0 : stored(5e-4 * random.uniform());
    }
    return inputs;
}

std::vector<TrainingPath> randomPaths(Random& random, size_t count) {
    std::vector<TrainingPath> paths(count);
    for (size_t p = 0; p < count; ++p) {
        const auto vertices = static_cast<size_t>(random.uniform() * (reference::kMaxRecorded + 1));
        while (paths[p].vertices.size() < vertices)
            paths[p].vertices.push_back(
                {randomInputs(random), randomColour(random, 0.0, 2.0), randomColour(random, 0.0, 1.5)});
        if (random.uniform() < 0.5)
            paths[p].end = randomInputs(random);
        else if (vertices > 0)
            paths[p].vertices.back().throughput = Vec3(0.0);
    }
    return paths;
}

double difference(const Vec3& actual, const Vec3& expected, double size) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c) {
        if (std::isnan(actual[c]) && std::isnan(expected[c])) continue;
        if (actual[c] == expected[c]) continue;
        const double d = std::abs(actual[c] - expected[c]) / size;
        worst = std::max(worst, std::isfinite(d) ? d : kInfinity);
    }
    return worst;
}

gpu::CacheState stateOf(double scale) {
    gpu::CacheState state{};
    state.scale = static_cast<float>(scale);
    return state;
}

CacheBench::CacheBench(QuadAccess form)
    : device(deviceWith(form))
    , counters(makeBuffer(device, "counters", std::vector<uint32_t>(gpu::kCacheCounters)))
    , state(makeBuffer(device, "state", std::vector{stateOf(1.0)})) {}

void CacheBench::set(uint32_t counter, uint32_t value) {
    upload<uint32_t>(device, counters, std::vector{value}, counter * 4);
}
uint32_t CacheBench::counter(uint32_t counter) const {
    return download<uint32_t>(device, counters, 1, counter * 4).front();
}
void CacheBench::set(const gpu::CacheState& value) {
    upload<gpu::CacheState>(device, state, std::vector{value});
}
gpu::CacheState CacheBench::readState() const {
    return download<gpu::CacheState>(device, state, 1).front();
}

const Kernel& CacheBench::kernel(const KernelSource& source) {
    static auto* kernels =
        new std::map<std::pair<Device*, std::string>, Kernel>; // outlives all, as its device
    const std::pair key(&device, std::string(source.name));
    if (!kernels->contains(key)) kernels->emplace(key, Kernel(device, source));
    return kernels->at(key);
}

} // namespace irradia::test
