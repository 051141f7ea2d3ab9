// Buffers of a radiance cache (shared/cache.h) from the reference's paths and rows, and back.
#pragma once

#include "engine/gpu/buffer.h"
#include "shared/cache.h"
#include "tests/reference/cache.h"

namespace irradia::test {

using Quads = std::vector<glm::uvec4>;

// Rows of inputs in the order of quads, with room up to a multiple of gpu::kRowPadding.
Quads packInputs(const std::vector<reference::Values>& rows);
reference::Values unpackInputs(const Quads& quads, size_t row);

struct TrainingBuffers {
    Quads paths, vertices, queries;
};

TrainingBuffers packPaths(const std::vector<reference::TrainingPath>& paths);
std::vector<reference::TrainingPath> unpackPaths(const TrainingBuffers& buffers, size_t count);

// The rgb of a quad.
inline reference::Vec3 colour(const glm::uvec4& quad) {
    return reference::Vec3(std::bit_cast<glm::vec4>(quad));
}
inline glm::uvec4 quad(const reference::Vec3& v, uint32_t w = 0) {
    return {std::bit_cast<glm::uvec3>(glm::vec3(v)), w};
}

} // namespace irradia::test
