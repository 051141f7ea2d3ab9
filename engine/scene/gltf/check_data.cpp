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

    bool checkAll() {
        bool isGood = true;
        for (size_t i = 0; i < model_.bufferViews.size(); ++i) {
            isGoodView_.push_back(attempt([&] { checkBufferView(i); }));
            isGood = isGood && isGoodView_.back();
        }
        for (size_t i = 0; i < model_.accessors.size(); ++i)
            isGood = attempt([&] { checkAccessor(i); }) && isGood;
        return isGood;
    }

private:
    void checkBufferView(size_t index) const {
        const tinygltf::BufferView& view = model_.bufferViews[index];
        const Thing owner = thing("buffer view", "bufferViews", index, view.name);
        checkIndex(owner.at("buffer"), "buffer", view.buffer, model_.buffers.size(), Need::Required);
        const uint64_t size = model_.buffers[view.buffer].data.size();
        if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
            source_.refuse(owner.at("byteLength"), "BUFFER_VIEW_TOO_LONG",
                           "bytes {} + {} of the {} of buffer {}", view.byteOffset, view.byteLength, size,
                           view.buffer);
    }

    // `count` elements of `size` bytes, `stride` apart, from `offset` on, lie in the view.
    void checkRange(const Thing& owner, std::string_view code, int view, uint64_t offset, uint64_t count,
                    uint64_t size, uint64_t stride) const {
        checkIndex(owner.at("bufferView"), "buffer view", view, model_.bufferViews.size(), Need::Required);
        const uint64_t length = model_.bufferViews[view].byteLength;
        const bool fits =
            offset <= length &&
            (count == 0 || (size <= length - offset && count - 1 <= (length - offset - size) / stride));
        if (!fits)
            source_.refuse(
                owner, code,
                "{} elements of {} bytes, {} apart, from byte {} do not fit the {} bytes of buffer view {}",
                count, size, stride, offset, length, view);
    }

    void checkAccessor(size_t index) const {
        const tinygltf::Accessor& accessor = model_.accessors[index];
        const Thing owner = thing("accessor", "accessors", index, accessor.name);
        if (!isComponentType(accessor.componentType))
            source_.refuse(owner.at("componentType"), "VALUE_NOT_IN_LIST", "component type {}",
                           accessor.componentType);
        if (accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
            source_.refuse(owner.at("normalized"), "ACCESSOR_NORMALIZED_INVALID", "component type {}",
                           accessor.componentType);

        if (accessor.bufferView != -1) {
            checkIndex(owner.at("bufferView"), "buffer view", accessor.bufferView, model_.bufferViews.size(),
                       Need::Required);
            const uint64_t size = elementSize(accessor);
            const uint64_t stride = elementStride(model_, accessor);
            if (stride < size)
                source_.refuse(owner, "ACCESSOR_SMALL_BYTESTRIDE", "{} for {} bytes", stride, size);
            checkRange(owner, "ACCESSOR_TOO_LONG", accessor.bufferView, accessor.byteOffset, accessor.count,
                       size, stride);
        } else if (accessor.count > kMaxZeroElements) {
            source_.refuse(owner.at("count"), {},
                           "{} elements without a buffer view are more than the {} allowed", accessor.count,
                           kMaxZeroElements);
        }
        if (accessor.sparse.isSparse) checkSparse(owner, accessor);
    }

    void checkSparse(const Thing& whole, const tinygltf::Accessor& accessor) const {
        const auto& sparse = accessor.sparse;
        const Thing owner = whole.at("sparse"), indices = owner.at("indices");
        const int type = sparse.indices.componentType;
        if (!isIndexType(type))
            source_.refuse(indices.at("componentType"), "VALUE_NOT_IN_LIST", "sparse index type {}", type);
        if (sparse.count < 1 || static_cast<uint64_t>(sparse.count) > accessor.count)
            source_.refuse(owner.at("count"), "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "{} of {}", sparse.count,
                           accessor.count);
        const auto count = static_cast<uint64_t>(sparse.count);
        const uint64_t indexSize = componentSize(type), size = elementSize(accessor);
        checkRange(indices, "ACCESSOR_TOO_LONG (sparse indices)", sparse.indices.bufferView,
                   static_cast<uint64_t>(sparse.indices.byteOffset), count, indexSize, indexSize);
        checkRange(owner.at("values"), "ACCESSOR_TOO_LONG (sparse values)", sparse.values.bufferView,
                   static_cast<uint64_t>(sparse.values.byteOffset), count, size, size);
        if (!isGoodView_[sparse.indices.bufferView]) return; // which was told

        int64_t previous = -1;
        for (uint64_t i = 0; i < count; ++i) {
            const int64_t at = sparseIndex(model_, accessor, i);
            if (at <= previous)
                source_.refuse(indices, "ACCESSOR_SPARSE_INDICES_NON_INCREASING", "{} after {}", at,
                               previous);
            if (static_cast<uint64_t>(at) >= accessor.count)
                source_.refuse(indices, "ACCESSOR_SPARSE_INDEX_OOB", "{} of {}", at, accessor.count);
            previous = at;
        }
    }

    std::vector<bool> isGoodView_;
};

} // namespace

bool checkData(const SourceFile& source, const tinygltf::Model& model) {
    return DataCheck(source, model).checkAll();
}

} // namespace irradia::gltf
