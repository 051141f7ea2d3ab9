// Reading accessors element by element: any component type, normalised or not, strided, sparse.
#pragma once

#include "engine/scene/gltf/model.h"
#include <cstdint>
#include <glm/glm.hpp>

namespace irradia::gltf {

bool isComponentType(int type); // the six of glTF 2.0
bool isIndexType(int type);     // the unsigned three
uint64_t componentSize(int type);

uint64_t elementSize(const tinygltf::Accessor& accessor);
uint64_t elementStride(const tinygltf::Model& model, const tinygltf::Accessor& accessor);
uint32_t sparseIndex(const tinygltf::Model& model, const tinygltf::Accessor& accessor, uint64_t i);

// A view of one accessor of a model that has passed validateModel; the model must outlive it.
class AccessorView {
public:
    AccessorView(const tinygltf::Model& model, int accessor);

    uint64_t count() const { return accessor_.count; }

    // The first four components as floats, normalised if the accessor says so; missing ones are 0.
    glm::vec4 element(uint64_t i) const;

    // The same as stored, not normalised.
    glm::dvec4 stored(uint64_t i) const;

    // The same of the first four components of unsigned integers, as they stand.
    glm::uvec4 integers(uint64_t i) const;

    // A matrix of 4 x 4 floats.
    glm::mat4 matrix(uint64_t i) const;

    // A scalar of an unsigned type.
    uint32_t index(uint64_t i) const;

private:
    const uint8_t* address(uint64_t i) const; // null = zeros

    const tinygltf::Model& model_;
    const tinygltf::Accessor& accessor_;
    const uint8_t* dense_ = nullptr;
    const uint8_t* sparseValues_ = nullptr;
    uint64_t size_;
    uint64_t stride_ = 0;
    int components_;
};

} // namespace irradia::gltf
