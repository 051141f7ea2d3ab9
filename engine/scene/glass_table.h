// What rough glass loses of a direction and, in the mean, of all: the numbers behind its multiple-scattering
// lobe (shaders/lib/glass.glsl), which gives back what single scattering loses.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace irradia {

// In the order of shaders/shared/glass_table.h. `reflectanceTable` is buildReflectanceTable's.
std::vector<glm::vec4> buildGlassTable(const std::vector<glm::vec4>& reflectanceTable);

} // namespace irradia
