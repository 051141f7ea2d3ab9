#include "engine/scene/glass_table.h"

#include "engine/scene/glass_energy.h"
#include "engine/scene/reflectance_table.h"
#include "shared/glass_table.h"
#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

namespace irradia {

namespace {

constexpr uint32_t kColumns = gpu::kGlassCosines, kRows = gpu::kGlassAlphas, kSlices = gpu::kGlassIndices;
constexpr uint32_t kMeanRows = gpu::kGlassMeanAlphas, kMeanSlices = gpu::kGlassMeanIndices;

double fraction(uint32_t i, uint32_t nodes) {
    return double(i) / (nodes - 1);
}

// The inverses of glassColumn (by bisection) and glassSlice.
double cosineOf(double column, double alpha) {
    double lower = 0.0, upper = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double mu = 0.5 * (lower + upper);
        (gpu::glassColumn(float(mu), float(alpha)) < column ? lower : upper) = mu;
    }
    return std::max(upper, 1e-6); // at 0 nothing is left of a lobe but its limit
}

double indexOf(double slice, double scale, bool isDense) {
    const double last = 1.0 - 1.0 / gpu::kGlassMaxIndex;
    const double sparse = 1.0 - std::min(scale * (std::pow(1.0 + last / scale, slice) - 1.0), last);
    return isDense ? sparse : 1.0 / sparse;
}

// Losses at the nodes and between them, as the shaders interpolate.
class Losses {
public:
    Losses()
        : nodes_(size_t(2) * kSlices * kRows * kColumns) {
        tbb::parallel_for(uint32_t(0), kRows * kColumns, [&](uint32_t i) {
            const uint32_t row = i / kColumns, column = i % kColumns;
            const double alpha = reflectanceAlpha(fraction(row, kRows));
            const double mu = cosineOf(fraction(column, kColumns), alpha);
            const GlassEnergy energy(mu, alpha);
            const double scale = gpu::glassSliceScale(float(mu), float(alpha));
            for (uint32_t side = 0; side < 2; ++side)
                for (uint32_t slice = 0; slice < kSlices; ++slice)
                    nodes_[index(side, column, row, slice)] =
                        energy.loss(indexOf(fraction(slice, kSlices), scale, side == 1));
        });
    }

    double node(uint32_t side, uint32_t column, uint32_t row, uint32_t slice) const {
        return nodes_[index(side, column, row, slice)];
    }

    double at(float mu, float alpha, float eta) const {
        const float x = gpu::glassColumn(mu, alpha) * (kColumns - 1);
        const float y = std::max(gpu::glassRow(alpha), 0.0f) * (kRows - 1);
        const float z = gpu::glassSlice(eta, gpu::glassSliceScale(mu, alpha)) * (kSlices - 1);
        const uint32_t i = std::min(uint32_t(x), kColumns - 2), j = std::min(uint32_t(y), kRows - 2),
                       k = std::min(uint32_t(z), kSlices - 2);
        const uint32_t side = eta < 1.0f ? 1 : 0;
        const auto alongRow = [&](uint32_t row, uint32_t slice) {
            return std::lerp(node(side, i, row, slice), node(side, i + 1, row, slice), double(x - float(i)));
        };
        const auto alongSlice = [&](uint32_t slice) {
            return std::lerp(alongRow(j, slice), alongRow(j + 1, slice), double(y - float(j)));
        };
        return std::lerp(alongSlice(k), alongSlice(k + 1), double(z - float(k)));
    }

private:
    static size_t index(uint32_t side, uint32_t column, uint32_t row, uint32_t slice) {
        return ((size_t(side) * kSlices + slice) * kRows + row) * kColumns + column;
    }

    std::vector<double> nodes_;
};

// 2 int L mu dmu by the midpoint rule: cosines are those of the ends and middles of kMeanSteps even steps of
// a table's column, loss(i, mu) is L at the i-th of them.
constexpr uint32_t kMeanSteps = 126;

template <typename Loss>
double meanLoss(const std::vector<double>& cosines, Loss&& loss) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < cosines.size(); i += 2)
        sum += loss(i + 1, cosines[i + 1]) * (cosines[i + 2] * cosines[i + 2] - cosines[i] * cosines[i]);
    return sum;
}

void packLosses(const Losses& losses, std::vector<glm::vec4>& table) {
    for (uint32_t side = 0; side < 2; ++side)
        for (uint32_t k = 0; k + 1 < kSlices; ++k)
            for (uint32_t j = 0; j + 1 < kRows; ++j)
                for (uint32_t i = 0; i < kColumns; ++i)
                    table[gpu::glassQuad(side, i, j, k)] = {
                        losses.node(side, i, j, k), losses.node(side, i, j + 1, k),
                        losses.node(side, i, j, k + 1), losses.node(side, i, j + 1, k + 1)};
}

void packMeans(const Losses& losses, std::vector<glm::vec4>& table) {
    std::vector<float> means(size_t(2) * kMeanSlices * kMeanRows);
    tbb::parallel_for(uint32_t(0), kMeanRows, [&](uint32_t row) {
        const double alpha = reflectanceAlpha(fraction(row, kMeanRows));
        const double scale = gpu::glassMeanSliceScale(float(alpha));
        std::vector<double> cosines; // at the ends and middles of the steps
        for (uint32_t i = 0; i <= 2 * kMeanSteps; ++i)
            cosines.push_back(cosineOf(double(i) / (2 * kMeanSteps), alpha));
        for (uint32_t i = 0; i < 2 * kMeanSlices; ++i) {
            const double eta = indexOf(fraction(i % kMeanSlices, kMeanSlices), scale, i >= kMeanSlices);
            const double mean = meanLoss(
                cosines, [&](size_t, double mu) { return losses.at(float(mu), float(alpha), float(eta)); });
            means[i * kMeanRows + row] = float(std::log2(mean));
        }
    });
    for (uint32_t side = 0; side < 2; ++side)
        for (uint32_t k = 0; k + 1 < kMeanSlices; ++k)
            for (uint32_t j = 0; j + 1 < kMeanRows; ++j) {
                const float* low = &means[(side * kMeanSlices + k) * kMeanRows + j];
                const float* high = low + kMeanRows;
                table[gpu::glassMeanQuad(side, j, k)] = {low[0], low[1], high[0], high[1]};
            }
}

void packSheetMeans(const std::vector<glm::vec4>& reflectance, std::vector<glm::vec4>& table) {
    std::vector<float> means;
    for (uint32_t row = 0; row < kMeanRows; ++row) {
        const double alpha = reflectanceAlpha(fraction(row, kMeanRows));
        std::vector<double> cosines;
        for (uint32_t i = 0; i <= 2 * kMeanSteps; ++i)
            cosines.push_back(reflectanceCosine(double(i) / (2 * kMeanSteps), alpha));
        const glm::vec4* nodes = &reflectance[row * gpu::kTableCosines];
        const double mean = meanLoss(cosines, [&](size_t i, double) {
            const double x = double(i) / (2 * kMeanSteps) * (gpu::kTableCosines - 1);
            const size_t first = size_t(x);
            const auto loss = [&](size_t node) {
                return 1.0 - double(nodes[node].x) - double(nodes[node].y);
            };
            return std::lerp(loss(first), loss(first + 1), x - double(first));
        });
        means.push_back(float(std::log2(mean)));
    }
    for (uint32_t j = 0; j + 1 < kMeanRows; ++j)
        table[gpu::kGlassFirstSheet + j] = {means[j], means[j + 1], 0.0f, 0.0f};
}

} // namespace

std::vector<glm::vec4> buildGlassTable(const std::vector<glm::vec4>& reflectanceTable) {
    std::vector<glm::vec4> table(gpu::kGlassTableQuads);
    const Losses losses;
    packLosses(losses, table);
    packMeans(losses, table);
    packSheetMeans(reflectanceTable, table);
    return table;
}

} // namespace irradia
