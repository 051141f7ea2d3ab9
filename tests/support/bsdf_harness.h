// Materials and view directions for the BSDF's harness kernels.
#pragma once

#include "tests/reference/bsdf.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"

namespace irradia::test {

struct BsdfCase {
    reference::BsdfParameters material; // every number a float
    glm::vec3 view{0.0f, 0.0f, 1.0f};   // local
};

// At cosine mu to the normal, a case with the material as the GPU gets it: rounded to single precision.
BsdfCase bsdfCase(const reference::BsdfParameters& material, double mu, double azimuth = 0.3);

// The input `cases` of tests/shaders/bsdf_case.glsl.
Buffer caseBuffer(const std::vector<BsdfCase>& cases);
const Buffer& reflectanceTable();

struct BsdfEvaluation {
    glm::vec3 fCos;
    float pdf;
    float mend;
    float pSpecular; // probability of sampling the GGX lobe
};

// Case i towards direction i.
std::vector<BsdfEvaluation> evaluateBsdf(const std::vector<BsdfCase>& cases,
                                         const std::vector<glm::vec3>& directions,
                                         const std::vector<Specialisation>& faults = {});

// Constants that plant faults (bsdf_case.glsl).
inline constexpr uint32_t kRadianceFault = 40;
inline constexpr uint32_t kPdfFault = 41;
inline constexpr uint32_t kAlphaFault = 42;
inline constexpr uint32_t kLobeFault = 43;

} // namespace irradia::test
