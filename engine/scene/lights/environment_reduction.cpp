#include "engine/scene/lights/environment_reduction.h"

#include <algorithm>

namespace irradia {
namespace {

// Texel i of `to` along one axis covers the interval [i, i + 1) * from / to of the larger picture.
struct Cover {
    int first;
    std::vector<float> weights; // of texels from `first` on; their sum is 1
};

std::vector<Cover> boxFilter(int from, int to) {
    std::vector<Cover> covers;
    const double width = double(from) / to;
    for (int i = 0; i < to; ++i) {
        const double begin = i * width, end = (i + 1) * width;
        Cover& cover = covers.emplace_back(Cover{static_cast<int>(begin), {}});
        for (int k = cover.first; k < from && k < end; ++k)
            cover.weights.push_back(
                static_cast<float>((std::min<double>(k + 1, end) - std::max<double>(k, begin)) / width));
    }
    return covers;
}

// An odd size rounds up, and texels in between are shared: no column is lost, so no sun in it.
Environment halve(const Environment& large) {
    Environment small;
    small.width = (large.width + 1) / 2;
    small.height = (large.height + 1) / 2;
    small.texels.reserve(size_t(small.width) * size_t(small.height));
    const std::vector<Cover> columns = boxFilter(large.width, small.width);
    for (const Cover& rows : boxFilter(large.height, small.height))
        for (const Cover& cover : columns) {
            glm::vec3 sum(0.0f);
            for (size_t y = 0; y < rows.weights.size(); ++y) {
                const glm::vec3* row =
                    &large.texels[(size_t(rows.first) + y) * size_t(large.width) + size_t(cover.first)];
                for (size_t x = 0; x < cover.weights.size(); ++x)
                    sum += rows.weights[y] * cover.weights[x] * row[x];
            }
            small.texels.push_back(sum);
        }
    return small;
}

} // namespace

void reduceToFit(Environment& environment, uint64_t maxTexels) {
    while (environment.texels.size() > maxTexels) environment = halve(environment);
}

} // namespace irradia
