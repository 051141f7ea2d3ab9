#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/inspect.h"
#include <cmath>
#include <limits>
#include <set>

namespace irradia::gltf {
namespace {

constexpr double kUnitTolerance = 0.00674; // Khronos' validator's: what 8 bits a component round

class AccessorInspection {
public:
    AccessorInspection(const SourceFile& source, const tinygltf::Model& model)
        : source_(source)
        , model_(model) {}

    void inspectAll() const {
        for (size_t i = 0; i < model_.accessors.size(); ++i) {
            const tinygltf::Accessor& accessor = model_.accessors[i];
            const Thing owner = thing("accessor", "accessors", i, accessor.name);
            inspectAlignment(owner, accessor);
            inspectBounds(owner, static_cast<int>(i), accessor);
        }
        for (const int accessor : directions()) inspectLengths(accessor);
    }

private:
    void inspectAlignment(const Thing& owner, const tinygltf::Accessor& accessor) const {
        const uint64_t size = componentSize(accessor.componentType);
        if (accessor.byteOffset % size != 0)
            source_.warn(owner.at("byteOffset"), "ACCESSOR_OFFSET_ALIGNMENT",
                         "offset {} is not a multiple of {}", accessor.byteOffset, size);
        if (accessor.bufferView < 0) return;
        const uint64_t total = accessor.byteOffset + model_.bufferViews[accessor.bufferView].byteOffset;
        if (total % size != 0)
            source_.warn(owner, "ACCESSOR_TOTAL_OFFSET_ALIGNMENT",
                         "offset {} in the buffer is not a multiple of {}", total, size);
    }

    // Declared bounds are those of the stored numbers, normalised or not (glTF 2.0, 3.6.2.5).
    void inspectBounds(const Thing& owner, int index, const tinygltf::Accessor& accessor) const {
        const auto components =
            static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
        const bool hasLeast = accessor.minValues.size() == components;
        const bool hasMost = accessor.maxValues.size() == components;
        if (components > 4 || accessor.count == 0 || !(hasLeast || hasMost)) return;
        const AccessorView view(model_, index);
        glm::dvec4 least(std::numeric_limits<double>::infinity()), most(-least);
        for (uint64_t i = 0; i < view.count(); ++i) {
            const glm::dvec4 value = view.stored(i);
            least = glm::min(least, value);
            most = glm::max(most, value);
        }
        const bool isFloat = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
        const auto compare = [&](const char* name, const char* code, const std::vector<double>& declared,
                                 const glm::dvec4& actual) {
            for (int c = 0; c < static_cast<int>(components); ++c) {
                const double stated = isFloat ? double{static_cast<float>(declared[c])} : declared[c];
                if (stated != actual[c])
                    return source_.warn(owner.at(name).at(static_cast<size_t>(c)), code,
                                        "{} of component {} is declared as {} and is {}", name, c,
                                        declared[c], actual[c]);
            }
        };
        if (hasLeast) compare("min", "ACCESSOR_MIN_MISMATCH", accessor.minValues, least);
        if (hasMost) compare("max", "ACCESSOR_MAX_MISMATCH", accessor.maxValues, most);
    }

    // Of normals and tangents.
    std::set<int> directions() const {
        std::set<int> found;
        for (const tinygltf::Mesh& mesh : model_.meshes)
            for (const tinygltf::Primitive& primitive : mesh.primitives)
                for (const auto& [name, accessor] : primitive.attributes) {
                    const bool isDirection = name == "NORMAL" || name == "TANGENT";
                    const bool isThere =
                        accessor >= 0 && static_cast<size_t>(accessor) < model_.accessors.size();
                    if (isDirection && isThere) found.insert(accessor);
                }
        return found;
    }

    void inspectLengths(int index) const {
        const AccessorView view(model_, index);
        uint64_t others = 0, first = 0;
        for (uint64_t i = 0; i < view.count(); ++i) {
            const bool isUnit = std::abs(glm::length(glm::dvec3(view.element(i))) - 1.0) <= kUnitTolerance;
            if (!isUnit && others++ == 0) first = i;
        }
        const auto at = static_cast<size_t>(index);
        if (others > 0)
            source_.warn(
                thing("accessor", "accessors", at, model_.accessors[at].name), "ACCESSOR_VECTOR3_NON_UNIT",
                "{} of {} directions are no unit vectors, element {} the first", others, view.count(), first);
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
};

} // namespace

void inspectAccessors(const SourceFile& source, const tinygltf::Model& model) {
    AccessorInspection(source, model).inspectAll();
}

} // namespace irradia::gltf
