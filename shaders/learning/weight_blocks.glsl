// Tiles of the network's matrices, each the work of one subgroup or workgroup: kOutputsTogether outputs by
// kQuadsTogether quads of inputs. Counted matrix by matrix; nrc/learning/network_kernels.cpp counts them in the same way.

struct Block {
    uint matrix;         // first quad of the matrix in the weights
    uint matrixQuads;    // of its rows
    uint firstOutput;    // of the block in the matrix
    uint quad;           // of this lane, in a row of the matrix; at matrixQuads or beyond it has no work
    uint gradientQuad;   // of firstOutput in a row of layerGradients
    uint gradientQuads;  // that exist from there on
    uint activationQuad; // of this lane in a row of activations, or of the encoded inputs where isInput
    bool isInput;
};

uint blocksAcross(uint quads) { return (quads + kQuadsTogether - 1u) / kQuadsTogether; }

// laneQuad: in [0, kQuadsTogether).
Block blockAt(uint index, uint laneQuad) {
    uint down = kWidthQuads * 4u / kOutputsTogether;
    uint first = down * blocksAcross(kInputQuads), hidden = down * blocksAcross(kWidthQuads);
    uint layer = index < first ? 0u : 1u + (index - first) / hidden;
    uint within = layer == 0u ? index : (index - first) % hidden;

    Block b;
    b.isInput = layer == 0u;
    b.matrixQuads = b.isInput ? kInputQuads : kWidthQuads;
    uint across = blocksAcross(b.matrixQuads);
    b.matrix = b.isInput ? kInputMatrix : kHiddenMatrices + (layer - 1u) * kHiddenMatrixQuads;
    b.firstOutput = within / across * kOutputsTogether;
    b.quad = within % across * kQuadsTogether + laneQuad;
    b.gradientQuad = layer * kWidthQuads + b.firstOutput / 4u;
    b.gradientQuads = layer == kHiddenLayers ? kOutputQuads : kOutputsTogether / 4u;
    b.activationQuad = b.isInput ? b.quad : (layer - 1u) * kWidthQuads + b.quad;
    return b;
}

vec4 activationOf(Block b, uint row) {
    return b.isInput ? loadValues(encoded, quadIndex(row, b.activationQuad, kInputQuads))
                     : loadValues(activations, quadIndex(row, b.activationQuad, kActivationQuads));
}
