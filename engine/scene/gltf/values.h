// Numbers and colours of one thing of the file, within the ranges they have: what is outside is clamped, with
// a warning.
#pragma once

#include "engine/scene/gltf/file.h"
#include "engine/scene/gltf/model.h"
#include <glm/glm.hpp>
#include <optional>

namespace irradia::gltf {

constexpr double kMaxRadiance = 1e20; // keeps products of radiance and throughput inside float
constexpr double kMaxScale = 1e6;     // of factors that glTF leaves unbounded

using Extension = const tinygltf::Value*; // an object, or null

// Of a thing's extensions the one of that name.
Extension findExtension(const tinygltf::ExtensionMap& extensions, const std::string& name);

// The member of an object; of anything else, and where there is none, a value of no type.
const tinygltf::Value& member(const tinygltf::Value& object, std::string_view key);

// A number as it stands there, or what stands for it.
double plainNumber(const tinygltf::Value& object, const std::string& key, double otherwise);

// The numbers of an array; none where there is no array, or something else in it.
std::vector<double> numbers(const tinygltf::Value& object, const std::string& key);

class Values {
public:
    Values(const SourceFile& source, Thing owner)
        : source_(source)
        , owner_(std::move(owner)) {}

    float number(const std::string& key, double value, double low, double high) const;
    float number(const tinygltf::Value& object, const std::string& key, double otherwise, double low,
                 double high) const {
        return number(key, plainNumber(object, key, otherwise), low, high);
    }

    // Of the first three values.
    glm::vec3 colour(const std::string& key, const std::vector<double>& values, double high) const;
    // White where the object has none.
    glm::vec3 colour(const tinygltf::Value& object, const std::string& key, double high) const;

    const Thing& owner() const { return owner_; }

private:
    const SourceFile& source_;
    Thing owner_;
};

} // namespace irradia::gltf
