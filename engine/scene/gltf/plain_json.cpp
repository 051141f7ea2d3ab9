#include "engine/scene/gltf/plain_json.h"

#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/values.h"
#include <nlohmann/json.hpp>

namespace irradia::gltf {
namespace {

using Json = nlohmann::json;

// The member `name` of what is an object, else null.
Json* find(Json& json, std::string_view name) {
    if (!json.is_object()) return nullptr;
    const auto found = json.find(name);
    return found == json.end() ? nullptr : &*found;
}

// Calls visit with each element of an array that may not be one.
template <typename Visit>
void forEach(Json* array, Visit&& visit) {
    if (!array || !array->is_array()) return;
    for (Json& element : *array) visit(element);
}

Json* findExtension(Json& owner, std::string_view name) {
    Json* extensions = find(owner, "extensions");
    Json* extension = extensions ? find(*extensions, name) : nullptr;
    return extension && extension->is_object() ? extension : nullptr;
}

// Indices move into the extension, where tinygltf does not look.
void hideIndices(Json& primitive) {
    Json* draco = findExtension(primitive, kDraco);
    if (!draco) return;
    draco->erase("indices");
    Json* indices = find(primitive, "indices");
    if (!indices) return;
    (*draco)["indices"] = *indices;
    primitive.erase("indices");
}

// EXT_meshopt_compression, "fallback buffers": marked, or without a uri where that cannot mean the .glb's
// own.
bool standsForData(Json& buffer, bool isFirstOfGlb) {
    const Json* meshopt = findExtension(buffer, kMeshopt);
    if (meshopt && meshopt->value("fallback", Json()) == Json(true)) return true;
    return !isFirstOfGlb && buffer.is_object() && !buffer.contains("uri");
}

// One byte, of which no buffer view can make anything.
void emptyBuffer(Json& buffer) {
    buffer["byteLength"] = 1;
    buffer["uri"] = "data:application/octet-stream;base64,AA==";
}

} // namespace

std::vector<uint8_t> plainBytes(const SourceFile& source, const JsonFindings& findings) {
    const bool hasDraco = findings.extensionsFound.contains(kDraco);
    const bool hasMeshopt = findings.extensionsFound.contains(kMeshopt);
    if (!hasDraco && !hasMeshopt) return {};
    Json json = Json::parse(jsonText(source));
    if (!json.is_object()) return {};
    if (hasDraco)
        forEach(find(json, "meshes"), [](Json& mesh) { forEach(find(mesh, "primitives"), hideIndices); });
    bool isFirst = isBinary(source);
    if (hasMeshopt)
        forEach(find(json, "buffers"), [&](Json& buffer) {
            if (standsForData(buffer, isFirst)) emptyBuffer(buffer);
            isFirst = false;
        });
    return withJson(source, json.dump());
}

void restorePrimitives(tinygltf::Model& model) {
    for (tinygltf::Mesh& mesh : model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives)
            if (const Extension draco = findExtension(primitive.extensions, kDraco))
                primitive.indices = static_cast<int>(plainNumber(*draco, "indices", -1));
}

} // namespace irradia::gltf
