#include "engine/scene/lights/area_table.h"

#include "engine/scene/lights/alias_table.h"
#include <bit>

namespace irradia {
namespace {

glm::dvec3 toVector(const glm::uvec4& quad) {
    return glm::dvec3(glm::vec3(std::bit_cast<glm::vec4>(quad)));
}

} // namespace

void packAreaTable(PackedScene& packed) {
    std::vector<double> areas;
    for (size_t at = 0; at < packed.geometry.size(); at += gpu::kGeometryQuads)
        areas.push_back(0.5 * glm::length(glm::cross(toVector(packed.geometry[at + 1]),
                                                     toVector(packed.geometry[at + 2]))));
    packed.areaTable.clear();
    for (const AliasEntry& entry : buildAliasTable(areas))
        packed.areaTable.emplace_back(std::bit_cast<uint32_t>(entry.keep), entry.alias, 0u, 0u);
}

} // namespace irradia
