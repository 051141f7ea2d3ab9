#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variant pack_weights_half VALUES_IN_HALF
// Weights in the order in which the passes read them (mlp_shape.glsl): every matrix tiled, forwards and transposed.
#include "lib/kernel.glsl"
#include "learning/values.glsl"
#include "learning/mlp_shape.glsl"

WORDS_READ(0, weights);
VALUES_WRITE(1, packed);
layout(push_constant) uniform Push { PackParams params; };

// A matrix as it lies in the weights: element (row, column) at first + row * rowStride + column * columnStride.
struct Matrix {
    uint first;
    uint rowStride;
    uint columnStride;
    uint quads; // of a row, packed
};

float weightAt(Matrix m, uint row, uint column) {
    return uintBitsToFloat(loadWord(weights, m.first + row * m.rowStride + column * m.columnStride));
}

void packQuad(Matrix m, uint begin, uint index) {
    uint within = index - begin;
    uint row = within / (m.quads * kTileRows) * kTileRows + within % kTileRows;
    uint column = within / kTileRows % m.quads * 4u;
    storeValues(packed, index, vec4(weightAt(m, row, column), weightAt(m, row, column + 1u), weightAt(m, row, column + 2u),
                                  weightAt(m, row, column + 3u)));
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= params.packedQuads) return;
    bool transposed = index >= kTransposed;
    uint within = transposed ? index - kTransposed : index;
    uint width = kWidthQuads * 4u, inputs = kInputQuads * 4u;

    uint begin = kInputMatrix;
    uint rowLength = inputs; // of the matrix in the weights
    uint transposedQuads = kWidthQuads;
    if (within >= kOutputMatrix) {
        begin = kOutputMatrix;
        rowLength = width;
        transposedQuads = kOutputQuads;
    } else if (within >= kHiddenMatrices) {
        begin = kHiddenMatrices + (within - kHiddenMatrices) / kHiddenMatrixQuads * kHiddenMatrixQuads;
        rowLength = width;
    }
    Matrix m = transposed ? Matrix(begin * 4u, 1u, rowLength, transposedQuads)
                          : Matrix(begin * 4u, rowLength, 1u, rowLength / 4u);
    packQuad(m, transposed ? kTransposed + begin : begin, index);
}
