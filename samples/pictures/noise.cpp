#include "samples/pictures/pictures.h"
#include "samples/pictures/same_size.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace irradia {

Noise noiseOf(const LayeredImage& a, const LayeredImage& b, const LayeredImage& reference) {
    requireSameSize(std::array{a, b, reference});
    const std::vector<glm::vec3> first = a.rgb(), second = b.rgb(), truth = reference.rgb();
    std::vector<double> errors;
    for (size_t i = 0; i < truth.size(); ++i) {
        double sum = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double difference = double(first[i][c]) - second[i][c], t = truth[i][c];
            sum += 0.5 * difference * difference / (t * t + 0.01) / 3.0;
        }
        if (!std::isfinite(sum))
            fail(ExitCode::BadData, "{} or {}: pixels that are no numbers", a.name, b.name);
        errors.push_back(sum);
    }
    const auto mean = [&] {
        return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    };
    std::ranges::sort(errors);
    Noise noise;
    noise.all = mean();
    errors.resize(errors.size() - errors.size() / 100);
    noise.most = mean();
    return noise;
}

} // namespace irradia
