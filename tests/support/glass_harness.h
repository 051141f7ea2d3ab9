// Transmissive materials and view directions for glass's harness kernels.
#pragma once

#include "tests/reference/math.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"

namespace irradia::test {

struct GlassCase {
    glm::vec3 base{1.0f};
    float metallic = 0.0f;
    glm::vec3 f0{0.04f}; // of the material in air
    float ior = 1.5f;
    float specular = 1.0f;
    float roughness = 0.5f;
    float eta = 1.5f;
    float transmission = 1.0f;
    bool isSheet = false;
    glm::vec3 view{0.0f, 0.0f, 1.0f}; // local
};

// White glass between media of relative index eta, seen at cosine mu.
GlassCase whiteGlass(double eta, double roughness, double mu);
GlassCase whiteSheet(double roughness, double mu);

// The input `cases` of tests/shaders/glass_case.glsl.
Buffer caseBuffer(const std::vector<GlassCase>& cases);
const Buffer& glassTable();

struct GlassEvaluation {
    glm::vec3 fCos;
    float pdf;
    float mend; // smaller one of v's and l's
    float loss; // 1 - E(l)
    float pDiffuse, pFacets, pMultiple, pReturn;
    float multiple;     // f_ms / (1 - E(l))
    float eta;          // as the kernel has it
    bool transmits;     // has a transmission lobe
    glm::vec3 punctual; // f cos of what a punctual light may show in
};

// Case i towards direction i.
std::vector<GlassEvaluation> evaluateGlass(const std::vector<GlassCase>& cases,
                                           const std::vector<glm::vec3>& directions,
                                           const std::vector<Specialisation>& faults = {});

} // namespace irradia::test
