// Runs harness kernels (tests/shaders): functions of the shaders over arrays.
#pragma once

#include "engine/graph/frame_graph.h"
#include <bit>
#include <glm/glm.hpp>
#include <vector>

namespace irradia::test {

// The suite's device, made once, with validation on.
Device& validatedDevice();

// A sweep is as large as the variable asks for: true under IRRADIA_FULL=1.
bool fullSweep();

// Constant `id` as a float.
inline Specialisation floatConstant(uint32_t id, float value) {
    return {id, std::bit_cast<uint32_t>(value)};
}

// Quad and floats, bit by bit.
inline glm::uvec4 toQuad(const glm::vec4& v) {
    return std::bit_cast<glm::uvec4>(v);
}
inline glm::vec4 toFloats(const glm::uvec4& v) {
    return std::bit_cast<glm::vec4>(v);
}

class KernelHarness {
public:
    explicit KernelHarness(const KernelSource& source, const std::vector<Specialisation>& constants = {});

    // Binds `inputs` in order and then the output of `quads` quads, which is returned.
    template <typename Params>
    std::vector<glm::uvec4> run(const std::vector<BufferRange>& inputs, const Params& params, uint64_t items,
                                size_t quads) {
        Buffer output(validatedDevice(), "results", quads * sizeof(glm::uvec4));
        FrameGraph graph(validatedDevice());
        Pass pass = graph.pass(kernel_);
        for (const BufferRange& input : inputs) pass.read(input);
        pass.write(output).push(params).dispatch(items);
        graph.execute();
        return download<glm::uvec4>(validatedDevice(), output, quads);
    }

private:
    Kernel kernel_;
};

// A device buffer of quads, for inputs.
Buffer quadBuffer(const std::vector<glm::uvec4>& quads);
Buffer quadBuffer(const std::vector<glm::vec4>& quads);

} // namespace irradia::test
