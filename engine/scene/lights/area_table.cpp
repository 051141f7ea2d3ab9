#include "engine/scene/lights/area_table.h"

#include "engine/scene/lights/alias_table.h"
#include <bit>

namespace irradia {
namespace {

glm::dvec3 toVector(const glm::uvec4& record) {
    return glm::dvec3(glm::vec3(std::bit_cast<glm::vec4>(record)));
}

} // namespace

void packAreaTable(SceneRecords& records) {
    std::vector<double> areas;
    for (size_t at = 0; at < records.geometry.size(); at += gpu::kGeometryRecords)
        areas.push_back(0.5 * glm::length(glm::cross(toVector(records.geometry[at + 1]),
                                                     toVector(records.geometry[at + 2]))));
    records.areaTable.clear();
    for (const AliasEntry& entry : buildAliasTable(areas))
        records.areaTable.emplace_back(std::bit_cast<uint32_t>(entry.keep), entry.alias, 0u, 0u);
}

} // namespace irradia
