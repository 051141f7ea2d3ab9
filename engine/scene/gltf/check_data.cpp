#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/model_check.h"

namespace irradia::gltf {
namespace {

// An accessor without a buffer view is all zeros: only its sparse values are in the file, so the file bounds
// nothing.
constexpr uint64_t kMaxZeroElements = 1ull << 24;

class DataCheck : private ModelCheck {
public:
    using ModelCheck::ModelCheck;

    void checkAll() const {
        for (size_t i = 0; i < model_.bufferViews.size(); ++i) checkBufferView(i);
        for (size_t i = 0; i < model_.accessors.size(); ++i) checkAccessor(i);
    }

private:
    void checkBufferView(size_t index) const {
        const tinygltf::BufferView& view = model_.bufferViews[index];
        const std::string owner = label("buffer view", index, view.name);
        checkIndex(owner, "buffer", view.buffer, model_.buffers.size(), Need::Required);
        const uint64_t size = model_.buffers[view.buffer].data.size();
        if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
            source_.refuse("{}: BUFFER_VIEW_TOO_LONG: bytes {} + {} of the {} of buffer {}", owner,
                           view.byteOffset, view.byteLength, size, view.buffer);
    }

    // `count` elements of `size` bytes, `stride` apart, from `offset` on, lie in the view.
    void checkRange(const std::string& owner, std::string_view code, int view, uint64_t offset,
                    uint64_t count, uint64_t size, uint64_t stride) const {
        checkIndex(owner, "buffer view", view, model_.bufferViews.size(), Need::Required);
        const uint64_t length = model_.bufferViews[view].byteLength;
        const bool fits =
            offset <= length &&
            (count == 0 || (size <= length - offset && count - 1 <= (length - offset - size) / stride));
        if (!fits)
            source_.refuse(
                "{}: {}: {} elements of {} bytes, {} apart, from byte {} do not fit the {} bytes of "
                "buffer view {}",
                owner, code, count, size, stride, offset, length, view);
    }

    void checkAccessor(size_t index) const {
        const tinygltf::Accessor& accessor = model_.accessors[index];
        const std::string owner = label("accessor", index, accessor.name);
        if (!isComponentType(accessor.componentType))
            source_.refuse("{}: VALUE_NOT_IN_LIST: component type {}", owner, accessor.componentType);
        if (accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
            source_.refuse("{}: ACCESSOR_NORMALIZED_INVALID: component type {}", owner,
                           accessor.componentType);

        if (accessor.bufferView != -1) {
            checkIndex(owner, "buffer view", accessor.bufferView, model_.bufferViews.size(), Need::Required);
            const uint64_t size = elementSize(accessor);
            const uint64_t stride = elementStride(model_, accessor);
            if (stride < size)
                source_.refuse("{}: ACCESSOR_SMALL_BYTESTRIDE: {} for {} bytes", owner, stride, size);
            checkRange(owner, "ACCESSOR_TOO_LONG", accessor.bufferView, accessor.byteOffset, accessor.count,
                       size, stride);
        } else if (accessor.count > kMaxZeroElements) {
            source_.refuse("{}: {} elements without a buffer view are more than the {} allowed", owner,
                           accessor.count, kMaxZeroElements);
        }
        if (accessor.sparse.isSparse) checkSparse(owner, accessor);
    }

    void checkSparse(const std::string& owner, const tinygltf::Accessor& accessor) const {
        const auto& sparse = accessor.sparse;
        const int type = sparse.indices.componentType;
        if (!isIndexType(type)) source_.refuse("{}: VALUE_NOT_IN_LIST: sparse index type {}", owner, type);
        if (sparse.count < 1 || static_cast<uint64_t>(sparse.count) > accessor.count)
            source_.refuse("{}: ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE: {} of {}", owner, sparse.count,
                           accessor.count);
        const auto count = static_cast<uint64_t>(sparse.count);
        const uint64_t indexSize = componentSize(type), size = elementSize(accessor);
        checkRange(owner, "ACCESSOR_TOO_LONG (sparse indices)", sparse.indices.bufferView,
                   static_cast<uint64_t>(sparse.indices.byteOffset), count, indexSize, indexSize);
        checkRange(owner, "ACCESSOR_TOO_LONG (sparse values)", sparse.values.bufferView,
                   static_cast<uint64_t>(sparse.values.byteOffset), count, size, size);

        int64_t previous = -1;
        for (uint64_t i = 0; i < count; ++i) {
            const int64_t at = sparseIndex(model_, accessor, i);
            if (at <= previous)
                source_.refuse("{}: ACCESSOR_SPARSE_INDICES_NON_INCREASING: {} after {}", owner, at,
                               previous);
            if (static_cast<uint64_t>(at) >= accessor.count)
                source_.refuse("{}: ACCESSOR_SPARSE_INDEX_OOB: {} of {}", owner, at, accessor.count);
            previous = at;
        }
    }
};

} // namespace

void checkData(const SourceFile& source, const tinygltf::Model& model) {
    DataCheck(source, model).checkAll();
}

} // namespace irradia::gltf
