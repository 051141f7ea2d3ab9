#include "engine/scene/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace irradia::gltf {
namespace {

// Files may leave data unaligned, so components are copied, never cast.
template <typename T>
T load(const uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

// glTF 2.0, 3.6.2.2: signed values are symmetric, so the most negative one is clamped to -1.
template <typename T>
float loadAs(const uint8_t* from, bool normalized) {
    const auto value = static_cast<float>(load<T>(from));
    if (!normalized) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float component(const uint8_t* from, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return loadAs<int8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return loadAs<uint8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return loadAs<int16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return loadAs<uint16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return loadAs<uint32_t>(from, false);
    default:
        return load<float>(from);
    }
}

uint32_t unsignedInteger(const uint8_t* from, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(from);
    default:
        return load<uint32_t>(from);
    }
}

const uint8_t* viewBegin(const tinygltf::Model& model, int view) {
    const tinygltf::BufferView& bufferView = model.bufferViews[view];
    return model.buffers[bufferView.buffer].data.data() + bufferView.byteOffset;
}

int componentCount(const tinygltf::Accessor& accessor) {
    return tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
}

} // namespace

bool isIndexType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool isComponentType(int type) {
    return isIndexType(type) || type == TINYGLTF_COMPONENT_TYPE_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

uint64_t componentSize(int type) {
    return static_cast<uint64_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(type)));
}

// Columns of matrices start at multiples of 4 bytes (glTF 2.0, 3.6.2.4), which pads those of 1 and 2-byte
// components.
uint64_t elementSize(const tinygltf::Accessor& accessor) {
    const uint64_t size = componentSize(accessor.componentType);
    const auto components = static_cast<uint64_t>(componentCount(accessor));
    const bool matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
                        accessor.type == TINYGLTF_TYPE_MAT4;
    if (!matrix) return size * components;
    const uint64_t rows = accessor.type == TINYGLTF_TYPE_MAT2   ? 2
                          : accessor.type == TINYGLTF_TYPE_MAT3 ? 3
                                                                : 4;
    return rows * ((rows * size + 3) / 4 * 4);
}

uint64_t elementStride(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const uint64_t stride = model.bufferViews[accessor.bufferView].byteStride;
    return stride == 0 ? elementSize(accessor) : stride;
}

uint32_t sparseIndex(const tinygltf::Model& model, const tinygltf::Accessor& accessor, uint64_t i) {
    const auto& indices = accessor.sparse.indices;
    const uint8_t* begin = viewBegin(model, indices.bufferView) + indices.byteOffset;
    return unsignedInteger(begin + i * componentSize(indices.componentType), indices.componentType);
}

AccessorView::AccessorView(const tinygltf::Model& model, int accessor)
    : model_(model)
    , accessor_(model.accessors[accessor])
    , size_(elementSize(accessor_))
    , components_(std::min(componentCount(accessor_), 4)) {
    if (accessor_.bufferView >= 0) {
        dense_ = viewBegin(model, accessor_.bufferView) + accessor_.byteOffset;
        stride_ = elementStride(model, accessor_);
    }
    if (accessor_.sparse.isSparse)
        sparseValues_ =
            viewBegin(model, accessor_.sparse.values.bufferView) + accessor_.sparse.values.byteOffset;
}

const uint8_t* AccessorView::address(uint64_t i) const {
    if (sparseValues_) { // sparse indices increase strictly: search them by halves
        uint64_t first = 0, last = static_cast<uint64_t>(accessor_.sparse.count);
        while (first < last) {
            const uint64_t middle = (first + last) / 2;
            const uint32_t at = sparseIndex(model_, accessor_, middle);
            if (at == i) return sparseValues_ + middle * size_;
            if (at < i)
                first = middle + 1;
            else
                last = middle;
        }
    }
    return dense_ ? dense_ + i * stride_ : nullptr;
}

glm::vec4 AccessorView::element(uint64_t i) const {
    glm::vec4 value(0.0f);
    const uint8_t* from = address(i);
    if (!from) return value;
    const uint64_t size = componentSize(accessor_.componentType);
    for (int c = 0; c < components_; ++c)
        value[c] =
            component(from + static_cast<uint64_t>(c) * size, accessor_.componentType, accessor_.normalized);
    return value;
}

glm::dvec4 AccessorView::stored(uint64_t i) const {
    glm::dvec4 value(0.0);
    const uint8_t* from = address(i);
    if (!from) return value;
    const int type = accessor_.componentType;
    const uint64_t size = componentSize(type);
    for (int c = 0; c < components_; ++c) {
        const uint8_t* at = from + static_cast<uint64_t>(c) * size;
        if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) // which a float does not resolve
            value[c] = unsignedInteger(at, type);
        else
            value[c] = component(at, type, false);
    }
    return value;
}

glm::uvec4 AccessorView::integers(uint64_t i) const {
    glm::uvec4 value(0u);
    const uint8_t* from = address(i);
    if (!from) return value;
    const uint64_t size = componentSize(accessor_.componentType);
    for (int c = 0; c < components_; ++c)
        value[c] = unsignedInteger(from + static_cast<uint64_t>(c) * size, accessor_.componentType);
    return value;
}

glm::mat4 AccessorView::matrix(uint64_t i) const {
    glm::mat4 value(0.0f);
    if (const uint8_t* from = address(i)) std::memcpy(&value, from, sizeof value);
    return value;
}

uint32_t AccessorView::index(uint64_t i) const {
    const uint8_t* from = address(i);
    return from ? unsignedInteger(from, accessor_.componentType) : 0;
}

} // namespace irradia::gltf
