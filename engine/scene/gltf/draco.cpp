#include "engine/scene/gltf/draco.h"

#include "engine/scene/gltf/accessors.h"
#include "engine/scene/gltf/plain_json.h"
#include "engine/scene/gltf/primitives.h"
#include "engine/scene/gltf/values.h"
#include <cstring>
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <stdexcept>

namespace irradia::gltf {
namespace {

// Khronos' validator has no names for what is wrong inside the data.
constexpr std::string_view kInvalid = "DRACO_INVALID_STREAM";
constexpr std::string_view kMismatch = "DRACO_ACCESSOR_MISMATCH"; // the data are others than declared

constexpr uint64_t kBytesOfFace = 64; // what Draco takes for one while it decodes, at least

draco::DecoderBuffer bufferOf(std::span<const uint8_t> bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return buffer;
}

class PrimitiveDecoder {
public:
    PrimitiveDecoder(const SourceFile& source, tinygltf::Model& model, DecodedData& decoded,
                     tinygltf::Primitive& primitive, const tinygltf::Value& extension, const Thing& owner)
        : source_(source)
        , model_(model)
        , decoded_(decoded)
        , primitive_(primitive)
        , extension_(extension)
        , owner_(owner)
        , at_(owner.at("extensions").at(kDraco)) {}

    void decode() {
        if (primitive_.mode != TINYGLTF_MODE_TRIANGLES && primitive_.mode != TINYGLTF_MODE_TRIANGLE_STRIP)
            source_.refuse(owner_.at("mode"), "VALUE_NOT_IN_LIST", "mode {} of a compressed primitive",
                           primitive_.mode);
        const std::unique_ptr<draco::Mesh> mesh = decodeMesh(view());
        const tinygltf::Value& attributes = member(extension_, "attributes");
        if (!attributes.IsObject())
            source_.refuse(at_.at("attributes"), "UNDEFINED_PROPERTY", "there are none");
        for (const std::string& name : attributes.Keys())
            readAttribute(*mesh, name, static_cast<uint32_t>(plainNumber(attributes, name, 0)));
        readIndices(*mesh);
        primitive_.mode = TINYGLTF_MODE_TRIANGLES;
    }

private:
    std::span<const uint8_t> view() const {
        const int index = static_cast<int>(plainNumber(extension_, "bufferView", -1));
        if (index < 0 || static_cast<size_t>(index) >= model_.bufferViews.size())
            source_.refuse(at_.at("bufferView"), "UNRESOLVED_REFERENCE", "buffer view {} of {}", index,
                           model_.bufferViews.size());
        const tinygltf::BufferView& from = model_.bufferViews[index];
        return decoded_.encoded(thing("buffer view", "bufferViews", static_cast<size_t>(index), from.name),
                                from.buffer, from.byteOffset, from.byteLength);
    }

    std::unique_ptr<draco::Mesh> decodeMesh(std::span<const uint8_t> bytes) {
        encodedBytes_ = bytes.size();
        const uint64_t faces = statedFaces(bytes);
        decoded_.count(at_, faces * kBytesOfFace, encodedBytes_);
        draco::DecoderBuffer buffer = bufferOf(bytes);
        draco::Decoder decoder;
        std::string why = "it holds no mesh";
        try {
            auto result = decoder.DecodeMeshFromBuffer(&buffer);
            if (result.ok() && result.value()) return std::move(result).value();
            if (!result.ok()) why = result.status().error_msg_string();
        } catch (const std::length_error& error) { // of a vector that nothing could hold
            why = error.what();
        }
        refuseDamage(why);
    }

    // Draco makes room for the faces that its data state before it has read any of them.
    uint64_t statedFaces(std::span<const uint8_t> bytes) const {
        draco::DecoderBuffer buffer = bufferOf(bytes);
        draco::DracoHeader header;
        if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) refuseDamage("it has no header");
        if (header.version_major != 2 || header.version_minor != 2)
            source_.refuse(at_, "DRACO_UNKNOWN_VERSION", "Draco's bitstream {}.{}, only 2.2 can be read",
                           header.version_major, header.version_minor);
        if (header.encoder_type != draco::TRIANGULAR_MESH) refuseDamage("it holds no mesh");
        buffer.set_bitstream_version(static_cast<uint16_t>(DRACO_BITSTREAM_VERSION(2, 2)));
        draco::GeometryMetadata metadata;
        if ((header.flags & METADATA_FLAG_MASK) != 0 &&
            !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
            refuseDamage("its metadata are broken");
        // Sequential data state faces, then points; Edgebreaker's the kind of traversal, vertices, then
        // faces.
        uint8_t traversal = 0;
        uint32_t vertices = 0, faces = 0;
        const bool isEdgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
        if (isEdgebreaker && !(buffer.Decode(&traversal) && draco::DecodeVarint(&vertices, &buffer)))
            refuseDamage("it ends too early");
        if (!draco::DecodeVarint(&faces, &buffer)) refuseDamage("it ends too early");
        return faces;
    }

    void readAttribute(const draco::Mesh& mesh, const std::string& name, uint32_t id) {
        const Thing at = at_.called(name).at("attributes").at(name);
        const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
        if (!attribute) source_.refuse(at, "UNRESOLVED_REFERENCE", "the data have no attribute {}", id);
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end())
            source_.refuse(at, "UNRESOLVED_REFERENCE", "the primitive has no such attribute");
        tinygltf::Accessor& accessor = checkedAccessor(at, found->second, mesh.num_points());
        if (attribute->num_components() !=
            tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)))
            source_.refuse(at, kMismatch, "{} components, those of accessor {} are others",
                           int{attribute->num_components()}, found->second);
        setData(accessor, pointValues(at, mesh, *attribute, accessor));
    }

    tinygltf::Accessor& checkedAccessor(const Thing& at, int index, uint64_t count) const {
        if (index < 0 || static_cast<size_t>(index) >= model_.accessors.size())
            source_.refuse(at, "UNRESOLVED_REFERENCE", "accessor {} of {}", index, model_.accessors.size());
        tinygltf::Accessor& accessor = model_.accessors[index];
        if (accessor.count != count)
            source_.refuse(at, kMismatch, "{} elements, accessor {} has {}", count, index, accessor.count);
        return accessor;
    }

    std::vector<uint8_t> pointValues(const Thing& at, const draco::Mesh& mesh,
                                     const draco::PointAttribute& attribute,
                                     const tinygltf::Accessor& accessor) {
        switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return pointValues<int8_t>(at, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return pointValues<uint8_t>(at, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return pointValues<int16_t>(at, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return pointValues<uint16_t>(at, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return pointValues<uint32_t>(at, mesh, attribute);
        default:
            return pointValues<float>(at, mesh, attribute);
        }
    }

    template <typename T>
    std::vector<uint8_t> pointValues(const Thing& at, const draco::Mesh& mesh,
                                     const draco::PointAttribute& attribute) {
        const auto components = static_cast<int8_t>(attribute.num_components()); // at most 16, as the type's
        const uint64_t size = sizeof(T) * static_cast<uint64_t>(components);
        std::vector<uint8_t> bytes = decoded_.room(at, size * mesh.num_points(), encodedBytes_);
        T values[16];
        for (uint32_t i = 0; i < mesh.num_points(); ++i) {
            const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
            if (index.value() >= attribute.size() || !attribute.ConvertValue<T>(index, components, values))
                refuseDamage("a value is not there");
            std::memcpy(bytes.data() + size * i, values, size);
        }
        return bytes;
    }

    // Strips become lists, as Draco has them; those are of 4 bytes whatever the accessor says.
    void readIndices(const draco::Mesh& mesh) {
        const uint64_t count = uint64_t{mesh.num_faces()} * 3;
        const bool isList = primitive_.mode == TINYGLTF_MODE_TRIANGLES;
        if (primitive_.indices != -1 && isList) {
            checkedAccessor(owner_.called("indices").at("indices"), primitive_.indices, count);
        } else {
            primitive_.indices = static_cast<int>(model_.accessors.size());
            model_.accessors.emplace_back().count = count;
            model_.accessors.back().type = TINYGLTF_TYPE_SCALAR;
        }
        std::vector<uint8_t> bytes = decoded_.room(at_, 4 * count, encodedBytes_);
        for (uint32_t f = 0; f < mesh.num_faces(); ++f)
            for (size_t c = 0; c < 3; ++c) {
                const uint32_t index = mesh.face(draco::FaceIndex(f))[c].value();
                std::memcpy(bytes.data() + 4 * (uint64_t{f} * 3 + c), &index, 4);
            }
        tinygltf::Accessor& accessor = model_.accessors[primitive_.indices];
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        setData(accessor, std::move(bytes));
    }

    void setData(tinygltf::Accessor& accessor, std::vector<uint8_t> bytes) {
        accessor.bufferView = decoded_.addView(std::move(bytes));
        accessor.byteOffset = 0;
    }

    [[noreturn]] void refuseDamage(std::string_view why) const {
        source_.refuse(at_, kInvalid, "the {} bytes of compressed data are damaged: {}", encodedBytes_, why);
    }

    const SourceFile& source_;
    tinygltf::Model& model_;
    DecodedData& decoded_;
    tinygltf::Primitive& primitive_;
    const tinygltf::Value& extension_;
    const Thing& owner_;
    Thing at_;
    uint64_t encodedBytes_ = 0;
};

} // namespace

void decodeDraco(const SourceFile& source, tinygltf::Model& model, DecodedData& decoded) {
    for (size_t m = 0; m < model.meshes.size(); ++m)
        for (size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
            tinygltf::Primitive& primitive = model.meshes[m].primitives[p];
            const Extension extension = findExtension(primitive.extensions, kDraco);
            const Thing owner = primitiveThing(m, model.meshes[m], p);
            if (extension)
                source.attempt({}, {}, [&] {
                    PrimitiveDecoder(source, model, decoded, primitive, *extension, owner).decode();
                });
        }
}

} // namespace irradia::gltf
