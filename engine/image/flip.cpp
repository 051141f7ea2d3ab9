#include "engine/image/flip.h"

#include "engine/error.h"
#include "engine/image/flip_colours.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace irradia {
namespace {

using Plane = std::vector<float>; // one value per pixel

struct Size {
    int width;
    int height;
};

// ---- separable filters

// Weights at -radius ... radius.
struct Taps {
    int radius;
    std::vector<double> weights;
};

template <typename Function>
Taps makeTaps(int radius, Function f) {
    Taps taps{radius, {}};
    for (int x = -radius; x <= radius; ++x) taps.weights.push_back(f(static_cast<double>(x)));
    return taps;
}

// Positive weights are made to sum to 1 and negative ones to -1; a filter without negative ones
// sums to 1.
Taps normalised(Taps taps) {
    double positive = 0;
    double negative = 0;
    for (const double w : taps.weights) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : taps.weights) w /= w > 0 ? positive : negative > 0 ? negative : 1;
    return taps;
}

// out += weight * in, the step both directions are made of.
void addScaled(std::vector<double>& out, const float* in, double weight) {
    for (size_t i = 0; i < out.size(); ++i) out[i] += weight * in[i];
}

// Edge pixels are repeated outwards, along rows here and along columns below.
Plane filterRows(const Plane& in, Size size, const Taps& taps) {
    Plane out;
    out.reserve(in.size());
    const auto width = static_cast<size_t>(size.width);
    const auto radius = static_cast<size_t>(taps.radius);
    std::vector<float> padded(width + 2 * radius);
    for (size_t row = 0; row < in.size(); row += width) {
        for (size_t i = 0; i < padded.size(); ++i)
            padded[i] = in[row + std::clamp(i, radius, radius + width - 1) - radius];
        std::vector<double> sums(width);
        for (size_t k = 0; k < taps.weights.size(); ++k) addScaled(sums, padded.data() + k, taps.weights[k]);
        for (const double sum : sums) out.push_back(static_cast<float>(sum));
    }
    return out;
}

Plane filterColumns(const Plane& in, Size size, const Taps& taps) {
    Plane out;
    out.reserve(in.size());
    const auto width = static_cast<size_t>(size.width);
    for (int y = 0; y < size.height; ++y) {
        std::vector<double> sums(width);
        for (int k = -taps.radius; k <= taps.radius; ++k) {
            const auto row = static_cast<size_t>(std::clamp(y + k, 0, size.height - 1));
            addScaled(sums, in.data() + row * width, taps.weights[static_cast<size_t>(k + taps.radius)]);
        }
        for (const double sum : sums) out.push_back(static_cast<float>(sum));
    }
    return out;
}

Plane filterSeparably(const Plane& in, Size size, const Taps& alongX, const Taps& alongY) {
    return filterColumns(filterRows(in, size, alongX), size, alongY);
}

// ---- what the eye resolves: contrast sensitivity as sums of Gaussians in degrees

struct SensitivityGaussian {
    double a;
    double b; // degrees squared
};
using Sensitivity = std::array<SensitivityGaussian, 2>;
constexpr std::array<Sensitivity, 3> kSensitivities{{
    {{{1, 0.0047}, {0, 1e-5}}},     // achromatic
    {{{1, 0.0053}, {0, 1e-5}}},     // red-green
    {{{34.1, 0.04}, {13.5, 0.025}}} // blue-yellow
}};

// Each Gaussian is a sqrt(pi / b) exp(-pi^2 d^2 / b); the sum is scaled to weight 1 as a whole.
Plane filterBySensitivity(const Plane& in, Size size, const Sensitivity& sensitivity,
                          double pixelsPerDegree) {
    constexpr double kPi = std::numbers::pi;
    constexpr double kWidest = 0.04;
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixelsPerDegree));
    Plane out(in.size());
    double total = 0;
    for (const auto& [a, b] : sensitivity) {
        if (a == 0) continue;
        const double rate = kPi * kPi / (b * pixelsPerDegree * pixelsPerDegree);
        const Taps taps = makeTaps(radius, [rate](double x) { return std::exp(-rate * x * x); });
        double sum = 0;
        for (const double w : taps.weights) sum += w;
        const double weight = a * std::sqrt(kPi / b) * sum * sum;
        const Plane blurred = filterSeparably(in, size, normalised(taps), normalised(taps));
        for (size_t i = 0; i < in.size(); ++i) out[i] += static_cast<float>(weight * blurred[i]);
        total += weight;
    }
    for (float& value : out) value = static_cast<float>(value / total);
    return out;
}

// ---- the two halves of the metric

using Opponent = std::array<Plane, 3>; // Y, Cx, Cz

Opponent toOpponent(const Rgba8Image& image) {
    Opponent planes;
    for (size_t i = 0; i < image.pixels.size(); i += 4) {
        const glm::dvec3 c = toYCxCz(
            {toLinear(image.pixels[i]), toLinear(image.pixels[i + 1]), toLinear(image.pixels[i + 2])});
        for (int k = 0; k < 3; ++k) planes[static_cast<size_t>(k)].push_back(static_cast<float>(c[k]));
    }
    return planes;
}

std::vector<glm::dvec3> perceivedColours(const Opponent& planes, Size size, double pixelsPerDegree) {
    Opponent seen;
    for (size_t k = 0; k < 3; ++k)
        seen[k] = filterBySensitivity(planes[k], size, kSensitivities[k], pixelsPerDegree);
    std::vector<glm::dvec3> colours(planes[0].size());
    for (size_t i = 0; i < colours.size(); ++i) {
        const glm::dvec3 linear = fromYCxCz({seen[0][i], seen[1][i], seen[2][i]});
        colours[i] = toHuntLab(glm::clamp(linear, 0.0, 1.0));
    }
    return colours;
}

// The colour pipeline's end: the compressed HyAB distance, remapped so that 40 % of the largest one becomes
// 0.95.
double colourError(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kCompression = 0.7;
    constexpr double kKnee = 0.4;
    constexpr double kKneeError = 0.95;
    static const double largest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kCompression);
    const double distance = std::pow(hyab(a, b), kCompression);
    const double knee = kKnee * largest;
    if (distance < knee) return kKneeError * distance / knee;
    return std::min(1.0, kKneeError + (1 - kKneeError) * (distance - knee) / (largest - knee));
}

struct Features {
    Plane edges;  // magnitude of the first derivative
    Plane points; // magnitude of the second derivatives
};

Plane magnitude(const Plane& x, const Plane& y) {
    Plane out(x.size());
    for (size_t i = 0; i < x.size(); ++i) out[i] = std::hypot(x[i], y[i]);
    return out;
}

// The feature pipeline: derivatives of a Gaussian as wide as the eye's edge detector, 0.082 degrees, on
// luminance in [0, 1].
Features findFeatures(const Plane& luminance, Size size, double pixelsPerDegree) {
    constexpr double kDetectorDegrees = 0.082;
    const double sigma = 0.5 * kDetectorDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto gaussian = [sigma](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    const Taps smooth = normalised(makeTaps(radius, gaussian));
    const Taps slope = normalised(makeTaps(radius, [&](double x) { return -x * gaussian(x); }));
    const Taps bend =
        normalised(makeTaps(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); }));
    Plane normalisedLuminance(luminance.size());
    for (size_t i = 0; i < luminance.size(); ++i) normalisedLuminance[i] = (luminance[i] + 16) / 116;
    const auto filter = [&](const Taps& x, const Taps& y) {
        return filterSeparably(normalisedLuminance, size, x, y);
    };
    return {magnitude(filter(slope, smooth), filter(smooth, slope)),
            magnitude(filter(bend, smooth), filter(smooth, bend))};
}

double featureError(const Features& a, const Features& b, size_t pixel) {
    const double edge = std::abs(a.edges[pixel] - b.edges[pixel]);
    const double point = std::abs(a.points[pixel] - b.points[pixel]);
    return std::sqrt(std::max(edge, point) / std::numbers::sqrt2);
}

} // namespace

std::vector<float> flipErrors(const Rgba8Image& test, const Rgba8Image& reference, double pixelsPerDegree) {
    if (test.width != reference.width || test.height != reference.height)
        fail(ExitCode::BadData, "FLIP needs pictures of one size, not {} x {} and {} x {}", test.width,
             test.height, reference.width, reference.height);
    const Size size{test.width, test.height};
    const Opponent testPlanes = toOpponent(test);
    const Opponent referencePlanes = toOpponent(reference);
    const auto testColours = perceivedColours(testPlanes, size, pixelsPerDegree);
    const auto referenceColours = perceivedColours(referencePlanes, size, pixelsPerDegree);
    const Features testFeatures = findFeatures(testPlanes[0], size, pixelsPerDegree);
    const Features referenceFeatures = findFeatures(referencePlanes[0], size, pixelsPerDegree);
    std::vector<float> errors(testColours.size());
    for (size_t i = 0; i < errors.size(); ++i) {
        const double colour = colourError(testColours[i], referenceColours[i]);
        errors[i] =
            static_cast<float>(std::pow(colour, 1 - featureError(testFeatures, referenceFeatures, i)));
    }
    return errors;
}

} // namespace irradia
