#include "tests/support/cache_buffers.h"

#include "shared/network.h"
#include <bit>

namespace irradia::test {
namespace {

size_t padded(size_t rows) {
    return (std::max<size_t>(rows, 1) + gpu::kRowPadding - 1) / gpu::kRowPadding * gpu::kRowPadding;
}

glm::uvec4 quadOf(const reference::Values& inputs, uint32_t quad) {
    glm::vec4 values(0.0f);
    for (uint32_t i = 0; i < 4 && 4 * quad + i < inputs.size(); ++i)
        values[static_cast<int>(i)] = static_cast<float>(inputs[4 * quad + i]);
    return std::bit_cast<glm::uvec4>(values);
}

void append(reference::Values& inputs, const glm::uvec4& quad) {
    const auto values = std::bit_cast<glm::vec4>(quad);
    for (int i = 0; i < 4 && inputs.size() < gpu::kCacheInputs; ++i) inputs.push_back(double(values[i]));
}

constexpr size_t kPathVertices = size_t(gpu::kMaxTrainingVertices) * gpu::kTrainingVertexVectors;

} // namespace

Quads packInputs(const std::vector<reference::Values>& rows) {
    Quads records(padded(rows.size()) * gpu::kCacheInputQuads);
    for (uint32_t row = 0; row < rows.size(); ++row)
        for (uint32_t q = 0; q < gpu::kCacheInputQuads; ++q)
            records[gpu::quadIndex(row, q, gpu::kCacheInputQuads)] = quadOf(rows[row], q);
    return records;
}

reference::Values unpackInputs(const Quads& records, size_t row) {
    reference::Values inputs;
    for (uint32_t q = 0; q < gpu::kCacheInputQuads; ++q)
        append(inputs, records.at(gpu::quadIndex(static_cast<uint32_t>(row), q, gpu::kCacheInputQuads)));
    return inputs;
}

TrainingBuffers packPaths(const std::vector<reference::TrainingPath>& paths) {
    TrainingBuffers buffers;
    buffers.paths.resize(padded(paths.size()) * gpu::kTrainingPathVectors);
    buffers.vertices.resize(padded(paths.size()) * kPathVertices);
    std::vector<reference::Values> ends;
    for (size_t p = 0; p < paths.size(); ++p) {
        const auto vertices = static_cast<uint32_t>(paths[p].vertices.size());
        buffers.paths[p * gpu::kTrainingPathVectors].w = vertices;
        buffers.paths[p * gpu::kTrainingPathVectors + 1].w = paths[p].end ? 1 : 0;
        ends.push_back(paths[p].end.value_or(reference::Values(gpu::kCacheInputs)));
        for (size_t v = 0; v < vertices; ++v) {
            const reference::TrainingVertex& vertex = paths[p].vertices[v];
            glm::uvec4* at = &buffers.vertices[p * kPathVertices + v * gpu::kTrainingVertexVectors];
            for (uint32_t q = 0; q < gpu::kCacheInputQuads; ++q) at[q] = quadOf(vertex.inputs, q);
            at[gpu::kGathered] = quad(vertex.gathered);
            at[gpu::kThroughput] = quad(vertex.throughput);
        }
    }
    buffers.queries = packInputs(ends);
    return buffers;
}

std::vector<reference::TrainingPath> unpackPaths(const TrainingBuffers& buffers, size_t count) {
    std::vector<reference::TrainingPath> paths(count);
    for (size_t p = 0; p < count; ++p) {
        if (buffers.paths[p * gpu::kTrainingPathVectors + 1].w != 0)
            paths[p].end = unpackInputs(buffers.queries, p);
        for (size_t v = 0; v < buffers.paths[p * gpu::kTrainingPathVectors].w; ++v) {
            const glm::uvec4* at = &buffers.vertices.at(p * kPathVertices + v * gpu::kTrainingVertexVectors);
            reference::TrainingVertex& vertex = paths[p].vertices.emplace_back();
            for (uint32_t q = 0; q < gpu::kCacheInputQuads; ++q) append(vertex.inputs, at[q]);
            vertex.gathered = colour(at[gpu::kGathered]);
            vertex.throughput = colour(at[gpu::kThroughput]);
        }
    }
    return paths;
}

} // namespace irradia::test
