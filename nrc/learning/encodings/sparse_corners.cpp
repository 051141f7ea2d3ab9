#include "nrc/learning/encodings/sparse_corners.h"

#include "engine/error.h"
#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

// Lower corner of the voxel about a coordinate, by the arithmetic of shaders/learning/grid.glsl.
uint32_t cellOf(float x, float scale) {
    const float p = std::clamp(x, 0.0f, 1.0f) * scale;
    return static_cast<uint32_t>(std::floor(p + 0.5f));
}

} // namespace

std::vector<uint32_t> touchedCorners(const gpu::GridLevel& level, uint32_t dims,
                                     std::span<const glm::vec3> points) {
    std::vector<bool> isTouched(level.size, false);
    for (size_t i = 0; i < points.size(); ++i) {
        uint32_t lowest = 0, stride = 1;
        uint32_t strides[3] = {};
        for (uint32_t d = 0; d < dims; ++d, stride *= level.stride) {
            const float x = points[i][static_cast<int>(d)];
            if (!std::isfinite(x))
                fail(ExitCode::BadData, "encoding: point {} of the SparseGrid's {} is not finite", i,
                     points.size());
            strides[d] = stride;
            lowest += cellOf(x, level.scale) * stride;
        }
        for (uint32_t corner = 0; corner < 1u << dims; ++corner) {
            uint32_t index = lowest;
            for (uint32_t d = 0; d < dims; ++d) index += (corner >> d & 1u) * strides[d];
            isTouched[index] = true;
        }
    }
    std::vector<uint32_t> corners;
    for (uint32_t i = 0; i < level.size; ++i)
        if (isTouched[i]) corners.push_back(i);
    return corners;
}

} // namespace irradia
