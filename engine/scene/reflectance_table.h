// What the BSDF's lobes reflect of a direction, tabulated: the numbers behind the energy mend and the choice
// of lobes (shaders/lib/bsdf.glsl).
//   A(mu, alpha) = integral of (1 - Fc) D G2 / (4 v.z l.z) l.z dl,  B the same with Fc,  C(mu) = integral of
//   Fc l.z / pi dl
// with Fc = (1 - v.h)^5 and v at cosine mu. A + B is the GGX lobe's reflectance with F = 1.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace irradia {

// Records (A, B, C, 0) as floats in the order of shaders/shared/scene.h's reflectance table.
std::vector<glm::vec4> buildReflectanceTable();

// The cosine of a column and the alpha of a row, both in [0, 1].
double reflectanceCosine(double column, double alpha);
double reflectanceAlpha(double row);

} // namespace irradia
