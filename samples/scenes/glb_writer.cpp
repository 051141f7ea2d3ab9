#include "glb_writer.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace irradia::scenes {

namespace {

constexpr int kFloat = 5126, kUnsignedInt = 5125; // glTF's names of component types
constexpr int kRepeat = 10497, kLinear = 9729;

void padTo4(std::vector<uint8_t>& bytes, uint8_t filler) {
    while (bytes.size() % 4 != 0) bytes.push_back(filler);
}

void appendWord(std::vector<uint8_t>& bytes, size_t value) {
    for (size_t shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(value >> shift));
}

} // namespace

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

// Adds to a JSON array that appears with its first element; returns the element's index.
static int push(Json& gltf, const char* array, Json element) {
    gltf[array].push_back(std::move(element));
    return static_cast<int>(gltf[array].size()) - 1;
}

static Json numbers(const float* values, size_t count) {
    return Json(std::vector<float>(values, values + count));
}

int GlbWriter::addView(std::span<const uint8_t> bytes) {
    padTo4(binary_, 0);
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return push(gltf_, "bufferViews", std::move(view));
}

template <typename T>
int GlbWriter::addAccessor(const std::vector<T>& values, int componentType, const char* type) {
    std::vector<uint8_t> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    Json accessor = {{"bufferView", addView(bytes)},
                     {"componentType", componentType},
                     {"count", values.size()},
                     {"type", type}};
    if constexpr (std::is_same_v<T, glm::vec3>) { // required of positions, harmless elsewhere
        glm::vec3 lower = values.front(), upper = values.front();
        for (glm::vec3 value : values) {
            lower = glm::min(lower, value);
            upper = glm::max(upper, value);
        }
        accessor["min"] = numbers(glm::value_ptr(lower), 3);
        accessor["max"] = numbers(glm::value_ptr(upper), 3);
    }
    return push(gltf_, "accessors", std::move(accessor));
}

void GlbWriter::useExtension(const char* name) {
    Json& used = gltf_["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

Json& GlbWriter::extend(Json& material, const char* name) {
    useExtension(name);
    return material["extensions"][name];
}

int GlbWriter::addTexture(const std::string& name, const Rgba8Image& image) {
    if (!gltf_.contains("samplers"))
        push(gltf_, "samplers",
             Json{{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
    const int view = addView(encodePng(image));
    const int source =
        push(gltf_, "images", Json{{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
    return push(gltf_, "textures", Json{{"sampler", 0}, {"source", source}});
}

int GlbWriter::addMaterial(const GltfMaterial& m) {
    Json surface = {{"baseColorFactor", {m.baseColor.r, m.baseColor.g, m.baseColor.b, 1.0f}},
                    {"metallicFactor", m.metallic},
                    {"roughnessFactor", m.roughness}};
    if (m.baseColorTexture >= 0) surface["baseColorTexture"]["index"] = m.baseColorTexture;
    if (m.metallicRoughnessTexture >= 0)
        surface["metallicRoughnessTexture"]["index"] = m.metallicRoughnessTexture;
    Json material = {{"name", m.name}, {"pbrMetallicRoughness", std::move(surface)}};
    if (m.normalTexture >= 0) material["normalTexture"]["index"] = m.normalTexture;
    if (m.alphaMode != std::string("OPAQUE")) material["alphaMode"] = m.alphaMode;
    if (m.doubleSided) material["doubleSided"] = true;
    if (m.specular != 1.0f) extend(material, "KHR_materials_specular")["specularFactor"] = m.specular;
    if (m.transmission > 0.0f) {
        extend(material, "KHR_materials_transmission")["transmissionFactor"] = m.transmission;
        extend(material, "KHR_materials_ior")["ior"] = m.ior;
    }
    if (m.thickness > 0.0f) {
        Json& volume = extend(material, "KHR_materials_volume");
        volume["thicknessFactor"] = m.thickness;
        if (m.attenuationDistance > 0.0f) {
            volume["attenuationDistance"] = m.attenuationDistance;
            volume["attenuationColor"] = numbers(glm::value_ptr(m.attenuationColor), 3);
        }
    }
    const float strength = std::max({m.emission.r, m.emission.g, m.emission.b});
    if (strength > 1.0f) // emissiveFactor stays within 0..1
        extend(material, "KHR_materials_emissive_strength")["emissiveStrength"] = strength;
    const glm::vec3 factor = m.emission / std::max(strength, 1.0f);
    if (strength > 0.0f) material["emissiveFactor"] = numbers(glm::value_ptr(factor), 3);
    return push(gltf_, "materials", std::move(material));
}

int GlbWriter::addMesh(const std::string& name, std::span<const Part> parts) {
    Json primitives;
    for (const Part& part : parts) {
        const Mesh& mesh = *part.mesh;
        Json attributes = {{"POSITION", addAccessor(mesh.positions, kFloat, "VEC3")}};
        if (!mesh.normals.empty()) attributes["NORMAL"] = addAccessor(mesh.normals, kFloat, "VEC3");
        if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = addAccessor(mesh.uvs, kFloat, "VEC2");
        if (!mesh.tangents.empty()) attributes["TANGENT"] = addAccessor(mesh.tangents, kFloat, "VEC4");
        if (!mesh.colors.empty()) attributes["COLOR_0"] = addAccessor(mesh.colors, kFloat, "VEC3");
        primitives.push_back({{"attributes", std::move(attributes)},
                              {"indices", addAccessor(mesh.indices, kUnsignedInt, "SCALAR")},
                              {"material", part.material}});
    }
    return push(gltf_, "meshes", Json{{"name", name}, {"primitives", std::move(primitives)}});
}

int GlbWriter::addMesh(const std::string& name, const Mesh& mesh, int material) {
    const Part part{&mesh, material};
    return addMesh(name, std::span(&part, 1));
}

void GlbWriter::placeNode(const std::string& name, const glm::mat4& transform, const char* kind, Json what) {
    Json node = {{"name", name}, {kind, std::move(what)}};
    if (transform != glm::mat4(1.0f)) node["matrix"] = numbers(glm::value_ptr(transform), 16);
    push(gltf_, "nodes", std::move(node));
}

void GlbWriter::addNode(const std::string& name, int mesh, const glm::mat4& transform) {
    placeNode(name, transform, "mesh", mesh);
}

void GlbWriter::add(const std::string& name, const Mesh& mesh, int material, const glm::mat4& transform) {
    addNode(name, addMesh(name, mesh, material), transform);
}

int GlbWriter::addLight(const GltfLight& l) {
    useExtension("KHR_lights_punctual");
    const bool isSpot = l.cone.y > 0.0f;
    Json light = {{"type", l.isSun  ? "directional"
                           : isSpot ? "spot"
                                    : "point"},
                  {"color", numbers(glm::value_ptr(l.color), 3)},
                  {"intensity", l.intensity}};
    if (isSpot) light["spot"] = {{"innerConeAngle", l.cone.x}, {"outerConeAngle", l.cone.y}};
    return push(gltf_["extensions"]["KHR_lights_punctual"], "lights", std::move(light));
}

void GlbWriter::addLightNode(const std::string& name, int light, const glm::mat4& transform) {
    placeNode(name, transform, "extensions", {{"KHR_lights_punctual", {{"light", light}}}});
}

void GlbWriter::addCamera(const std::string& name, glm::vec3 eye, glm::vec3 target,
                          float verticalFovDegrees) {
    const Json lens = {{"yfov", glm::radians(verticalFovDegrees)}, {"znear", 0.01f}};
    const int camera =
        push(gltf_, "cameras", Json{{"name", name}, {"type", "perspective"}, {"perspective", lens}});
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    placeNode(name, glm::affineInverse(glm::lookAt(eye, target, up)), "camera", camera);
}

void GlbWriter::addSun(const std::string& name, glm::vec3 direction, glm::vec3 irradiance) {
    const float intensity = std::max({irradiance.r, irradiance.g, irradiance.b}); // colours stay within 0..1
    const int light = addLight({.color = irradiance / intensity, .intensity = intensity, .isSun = true});
    const glm::mat4 placed =
        glm::affineInverse(glm::lookAt(glm::vec3(0.0f), direction, glm::vec3(0.0f, 1.0f, 0.0f)));
    addLightNode(name, light, placed);
}

void GlbWriter::write(const std::filesystem::path& file) const {
    std::vector<uint8_t> binary = binary_;
    padTo4(binary, 0);
    Json gltf = gltf_;
    Json roots;
    for (size_t i = 0; i < gltf["nodes"].size(); i++) roots.push_back(i);
    gltf["scene"] = 0;
    gltf["scenes"].push_back({{"name", file.stem().string()}, {"nodes", std::move(roots)}});
    gltf["buffers"].push_back({{"byteLength", binary.size()}});
    const std::string text = gltf.dump();
    std::vector<uint8_t> json(text.begin(), text.end());
    padTo4(json, ' ');

    std::vector<uint8_t> glb;
    const size_t headers = 12 + 8 + 8;
    for (size_t word :
         {size_t{0x46546C67}, size_t{2}, headers + json.size() + binary.size()}) // "glTF", version
        appendWord(glb, word);
    const auto appendChunk = [&](const std::vector<uint8_t>& chunk, size_t type) {
        appendWord(glb, chunk.size());
        appendWord(glb, type);
        glb.insert(glb.end(), chunk.begin(), chunk.end());
    };
    appendChunk(json, 0x4E4F534A);   // "JSON"
    appendChunk(binary, 0x004E4942); // "BIN"
    writeFileAtomically(file, glb);
}

} // namespace irradia::scenes
