// Materials beyond metallic-roughness, as the scene has them: coverage, glass, unlit surfaces, texture
// transforms, vertex colours; and what of them is refused or mended.
#include "engine/scene/load_scene.h"
#include "engine/scene/scene_facts.h"
#include "tests/gltf_builder.h"
#include "tests/support/expect_error.h"
#include "tests/support/picture_bytes.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <functional>
#include <limits>

using namespace irradia;
using namespace irradia::test;

namespace {

// A triangle with two sets of coordinates, a picture and one material.
GltfBuilder textured(const std::string& material) {
    GltfBuilder builder;
    const Json attributes{{"POSITION", builder.vec3(kTriangle)},
                          {"TEXCOORD_0", builder.vec2(kTriangleUv)},
                          {"TEXCOORD_1", builder.vec2({{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}})}};
    builder.mesh({{"attributes", attributes}, {"material", 0}});
    const auto png = makePng({.width = 1, .height = 1}, {200, 100, 50});
    builder.json["images"] = {{{"bufferView", builder.view(png)}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {Json::parse(material)};
    std::vector<std::string> used;
    if (builder.json["materials"][0].contains("extensions"))
        for (const auto& [name, value] : builder.json["materials"][0]["extensions"].items())
            used.push_back(name);
    used.push_back("KHR_texture_transform");
    builder.json["extensionsUsed"] = used;
    return builder;
}

Scene load(const GltfBuilder& builder) {
    const TempFolder folder;
    return loadScene(folder.write("scene.glb", builder.glb()));
}

Material read(const std::string& material) {
    const Scene scene = load(textured(material));
    CHECK(scene.notes.warnings.empty());
    return scene.materials.at(0);
}

std::string warnings(const GltfBuilder& builder) {
    std::string all;
    for (const std::string& warning : load(builder).notes.warnings) all += warning + "\n";
    return all;
}

void checkRefused(const std::string& material, const std::string& sentence) {
    expectError(ExitCode::BadData, sentence, [&] { load(textured(material)); });
}

glm::vec2 at(const TextureRef& ref, glm::vec2 uv) {
    return ref.transform * glm::vec3(uv, 1.0f);
}

bool near(glm::vec2 a, glm::vec2 b) {
    return glm::length(a - b) < 1e-6f;
}

} // namespace

TEST_CASE("alpha modes, the factor's alpha and the cutoff") {
    const Material plain = read("{}");
    CHECK(plain.alphaMode == AlphaMode::Opaque);
    CHECK(plain.alpha == 1.0f);
    CHECK(plain.alphaCutoff == 0.5f);
    const Material mask = read(
        R"({"alphaMode": "MASK", "alphaCutoff": 0.25, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.75]}})");
    CHECK(mask.alphaMode == AlphaMode::Mask);
    CHECK(mask.alpha == 0.75f);
    CHECK(mask.alphaCutoff == 0.25f);
    CHECK(read(R"({"alphaMode": "BLEND"})").alphaMode == AlphaMode::Blend);
    CHECK(read(R"({"alphaMode": "MASK", "alphaCutoff": 1.5})").alphaCutoff == 1.5f); // nothing of it is there
    const Material old = read(R"({"alphaMode": "BLEND", "extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [1, 1, 1, 0.5]}}})");
    CHECK(old.alpha == 0.5f);
    checkRefused(R"({"alphaMode": "GLASS"})",
                 "material 0: VALUE_NOT_IN_LIST: alphaMode 'GLASS', there are OPAQUE, MASK, BLEND");
    CHECK(warnings(textured(R"({"alphaCutoff": -1})")) ==
          "material 0: alphaCutoff -1 is outside 0 to 1000000 and was clamped\n");
}

TEST_CASE("transmission, as a sheet and as a solid that absorbs") {
    const Material sheet = read(
        R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.75, "transmissionTexture": {"index": 0}}}})");
    CHECK(sheet.transmission == 0.75f);
    CHECK(sheet.transmissionTexture.image == 0);
    CHECK(sheet.isThin);
    CHECK(read(R"({"extensions": {"KHR_materials_transmission": {}}})").transmission == 0.0f);
    CHECK(read(R"({"extensions": {"KHR_materials_volume": {}}})").isThin);

    const Material solid = read(R"({"extensions": {"KHR_materials_volume":
        {"thicknessFactor": 0.1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0]}}})");
    CHECK_FALSE(solid.isThin);
    CHECK(solid.absorption.x == 0.0f);
    CHECK_FALSE(std::signbit(solid.absorption.x));
    CHECK(std::abs(solid.absorption.y - std::log(2.0f) / 2) < 1e-6f);
    CHECK(std::abs(solid.absorption.z - std::log(1e6f) / 2) < 1e-5f);
    const Material clear = read(
        R"({"extensions": {"KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": [0, 0, 0]}}})");
    CHECK_FALSE(clear.isThin);
    CHECK(clear.absorption == glm::vec3(0.0f)); // the distance is infinite

    const std::string odd = warnings(textured(R"({"extensions": {"KHR_materials_volume":
        {"thicknessFactor": -1}, "KHR_materials_transmission": {"transmissionFactor": 2}}})"));
    CHECK(odd == "material 0: transmissionFactor 2 is outside 0 to 1 and was clamped\n"
                 "material 0: thicknessFactor -1 is outside 0 to 1e+20 and was clamped\n");
    const Scene none = load(textured(R"({"extensions": {"KHR_materials_volume":
        {"thicknessFactor": 1, "attenuationDistance": 0, "attenuationColor": [0.5, 0.5, 0.5]}}})"));
    CHECK(none.notes.warnings.size() == 1);
    CHECK(std::isfinite(none.materials[0].absorption.x));
}

TEST_CASE("an index of refraction is 0, or 1 and above") {
    const auto ior = [](const char* value) {
        return textured(fmt::format(R"({{"extensions": {{"KHR_materials_ior": {{"ior": {}}}}}}})", value));
    };
    CHECK(load(ior("0")).materials[0].ior == 0.0f);
    CHECK(warnings(ior("0")).empty());
    CHECK(load(ior("0.5")).materials[0].ior == 1.0f);
    CHECK(warnings(ior("0.5")) == "material 0: ior 0.5 is neither 0 nor in 1 to 1000000 and was clamped\n");
}

TEST_CASE("values of another type are ignored, and loading says so") {
    const GltfBuilder builder = textured(R"({"emissiveFactor": "x", "extensions": {"KHR_materials_ior":
        {"ior": "big"}, "KHR_materials_specular": {"specularColorFactor": [0, "x", 0]}, "KHR_materials_unlit": 1,
        "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": "x", "attenuationColor": [0, 0, 0]}}})");
    const Material material = load(builder).materials[0];
    CHECK(material.emission == glm::vec3(0.0f));
    CHECK(material.ior == 1.5f);
    CHECK(material.specularColor == glm::vec3(1.0f));
    CHECK_FALSE(material.isUnlit);
    CHECK(material.absorption == glm::vec3(0.0f));
    const std::string at = "/materials/0/extensions/KHR_materials_";
    CHECK(warnings(builder) ==
          "/materials/0/emissiveFactor: TYPE_MISMATCH: \"x\" is no array of numbers and is ignored\n" + at +
              "unlit: TYPE_MISMATCH: 1 is no object and is ignored\n" + at +
              "ior/ior: TYPE_MISMATCH: \"big\" is no number and is ignored\n" + at +
              "specular/specularColorFactor: TYPE_MISMATCH: element 1 is no number\n" + at +
              "volume/attenuationDistance: TYPE_MISMATCH: \"x\" is no number and is ignored\n");
}

TEST_CASE("an unlit material is a lamp of its base colour") {
    const GltfBuilder builder =
        textured(R"({"alphaMode": "MASK", "emissiveFactor": [9, 9, 9], "normalTexture": {"index": 0},
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0, 0.75], "baseColorTexture": {"index": 0, "texCoord": 1}},
        "extensions": {"KHR_materials_unlit": {}, "KHR_materials_transmission": {"transmissionFactor": 1}}})");
    const Material material = load(builder).materials[0];
    CHECK(warnings(builder) == "material 0: KHR_materials_unlit makes it unlit, and its "
                               "KHR_materials_transmission is ignored\n");
    CHECK(material.isUnlit);
    CHECK(material.doubleSided);
    CHECK(material.emission == glm::vec3(0.5f, 1, 0));
    CHECK(material.emissiveFactor == material.emission);
    CHECK(material.baseColor == glm::vec3(0.0f));
    CHECK(material.metallic == 0.0f);
    CHECK(material.specular == 0.0f);
    CHECK(material.transmission == 0.0f);
    CHECK(material.alpha == 0.75f);
    CHECK(material.alphaMode == AlphaMode::Mask);
    CHECK(material.emissiveTexture.image == 0);
    CHECK(material.emissiveTexture.uvSet == 1);
    CHECK(material.baseColorTexture.image == 0);
    CHECK(material.normalTexture.image == -1);
}

TEST_CASE("texture transforms: scaled, turned counter-clockwise as seen, moved; in every texture info") {
    const std::string info = R"({"index": 0, "texCoord": 5, "extensions": {"KHR_texture_transform":
        {"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5], "texCoord": 1}}})";
    const Material material = read(R"({"pbrMetallicRoughness": {"baseColorTexture": )" + info +
                                   R"(, "metallicRoughnessTexture": )" + info + R"(}, "normalTexture": )" +
                                   info + R"(, "emissiveTexture": )" + info + R"(, "extensions": {
        "KHR_materials_specular": {"specularTexture": )" +
                                   info + R"(, "specularColorTexture": )" + info + R"(},
        "KHR_materials_transmission": {"transmissionTexture": )" +
                                   info + "}}}");
    for (const TextureRef* ref :
         {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
          &material.emissiveTexture, &material.specularTexture, &material.specularColorTexture,
          &material.transmissionTexture}) {
        CHECK(ref->image == 0);
        CHECK(ref->uvSet == 1);
        // The extension's own example: the lower left quadrant of the picture, a quarter turn clockwise.
        CHECK(near(at(*ref, {0, 0}), {0, 1}));
        CHECK(near(at(*ref, {1, 0}), {0, 0.5f}));
        CHECK(near(at(*ref, {0, 1}), {0.5f, 1}));
    }
    const Material flipped = read(R"({"emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0, 1], "scale": [2, -1]}}}})");
    CHECK(at(flipped.emissiveTexture, {0.25f, 0.25f}) == glm::vec2(0.5f, 0.75f));
    CHECK(flipped.emissiveTexture.uvSet == 0);
    const Material none =
        read(R"({"emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform": {}}}})");
    CHECK(none.emissiveTexture.transform == TextureRef().transform);
    checkRefused(
        R"({"emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [1]}}}})",
        "material 0: ARRAY_LENGTH_NOT_IN_LIST: scale of 1 numbers");
    checkRefused(
        R"({"extensions": {"KHR_materials_transmission": {"transmissionTexture": {"index": 0, "extensions":
            {"KHR_texture_transform": {"offset": [1, 2, 3]}}}}}})",
        "material 0 KHR_materials_transmission: ARRAY_LENGTH_NOT_IN_LIST: offset of 3 numbers");
    checkRefused(R"({"extensions": {"KHR_materials_transmission": {"transmissionTexture": {"index": 7}}}})",
                 "material 0 KHR_materials_transmission: UNRESOLVED_REFERENCE: texture 7 of 1");
    CHECK(warnings(textured(R"({"emissiveTexture": {"index": 0, "texCoord": 2}})")) ==
          "material 0: texture 0 uses coordinate set 2, only 0 and 1 can be used\n");
}

TEST_CASE("tangents follow the normal map's transform") {
    const auto tangent = [](const std::string& transform) {
        const Scene scene =
            load(textured(R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": )" +
                          transform + "}}}"));
        return scene.vertices[scene.triangles[0].vertex.x].tangent;
    };
    CHECK(glm::length(tangent("{}") - glm::vec4(1, 0, 0, 1)) < 1e-6f);
    // u' = v, v' = -u: +u of the picture is where v points, down.
    CHECK(glm::length(tangent(R"({"rotation": 1.57079632679})") - glm::vec4(0, -1, 0, 1)) < 1e-6f);
    CHECK(glm::length(tangent(R"({"scale": [-1, 1]})") - glm::vec4(-1, 0, 0, -1)) < 1e-6f);
}

namespace {

// The first vertex' colour, of three elements of `values`.
template <typename T>
glm::vec4 colorOf(int type, const std::string& shape, const std::vector<T>& values,
                  std::string* notes = nullptr) {
    GltfBuilder builder = textured("{}");
    const int view = builder.view(values);
    builder.json["bufferViews"][view]["byteStride"] = values.size() * sizeof(T) / 3;
    const int color = builder.accessor(view, type, 3, shape);
    builder.json["accessors"][color]["normalized"] = type != 5126;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = color;
    if (notes) *notes = warnings(builder);
    return load(builder).vertices[0].color;
}

} // namespace

TEST_CASE("vertex colours of three or four components, floats or normalised integers") {
    CHECK(load(textured("{}")).vertices[0].color == glm::vec4(1.0f));
    const std::vector<float> four{0.5f, 2, 0.25f, 0.75f, 0, 0, 0, 0, 0, 0, 0, 0};
    CHECK(colorOf(5126, "VEC4", four) == glm::vec4(0.5f, 2, 0.25f, 0.75f));
    CHECK(colorOf(5126, "VEC3", std::vector<float>{0.5f, 1, 0, 0, 0, 0, 0, 0, 0}) ==
          glm::vec4(0.5f, 1, 0, 1));
    CHECK(colorOf(5121, "VEC4", std::vector<uint8_t>{255, 51, 0, 102, 0, 0, 0, 0, 0, 0, 0, 0}) ==
          glm::vec4(1, 51.0f / 255, 0, 102.0f / 255));
    CHECK(colorOf(5123, "VEC3", std::vector<uint16_t>{65535, 13107, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0}) ==
          glm::vec4(1, 13107.0f / 65535, 0, 1));
    std::string notes;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    CHECK(colorOf(5126, "VEC3", std::vector<float>{-1, nan, inf, 0, 0, 0, 0, 0, 0}, &notes) ==
          glm::vec4(0, 0, 1e6f, 1));
    CHECK(
        notes ==
        "mesh 0 primitive 0: ACCESSOR_INVALID_FLOAT: colours that are negative, above 1000000 or not finite "
        "are clamped to 0 to 1000000, NaN to 0\n");
    expectError(ExitCode::BadData,
                "INVALID_FORMAT: accessor 3 holds VEC2 of floats, allowed are VEC3 or VEC4 of floats, "
                "normalised unsigned bytes, normalised unsigned shorts",
                [&] { colorOf(5126, "VEC2", std::vector<float>(9)); });
    for (const char* shape : {"VEC2", "SCALAR"})
        expectError(ExitCode::BadData,
                    "mesh 0 primitive 0 COLOR_0: MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
                    [&] { colorOf(5126, shape, std::vector<float>(9)); });
    expectError(ExitCode::BadData, "INVALID_FORMAT", [] { colorOf(5122, "VEC4", std::vector<int16_t>(12)); });
}

TEST_CASE("attributes of quantised meshes, normalised or not; others are refused") {
    const auto check = [](const std::string& name, const std::string& shape, int type, bool normalised,
                          bool isGood) {
        CAPTURE(name, shape, type, normalised);
        GltfBuilder builder = textured("{}");
        const int view = builder.view(std::vector<float>(12, 0.0f));
        const int accessor = builder.accessor(view, type, 3, shape);
        builder.json["accessors"][accessor]["normalized"] = normalised;
        Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
        attributes[name] = accessor;
        if (name == "JOINTS_0") attributes["WEIGHTS_0"] = builder.vec4(std::vector<glm::vec4>(3));
        builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
        if (isGood)
            CHECK_NOTHROW(load(builder));
        else
            expectError(ExitCode::BadData, "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
                        [&] { load(builder); });
    };
    for (const int type : {5120, 5121, 5122, 5123})
        for (const bool normalised : {false, true}) {
            const bool isSigned = type == 5120 || type == 5122;
            check("POSITION", "VEC3", type, normalised, true);
            check("TEXCOORD_0", "VEC2", type, normalised, true);
            check("TEXCOORD_1", "VEC2", type, normalised, true);
            check("NORMAL", "VEC3", type, normalised, isSigned && normalised);
            check("TANGENT", "VEC4", type, normalised, isSigned && normalised);
        }
    check("NORMAL", "VEC3", 5126, false, true);
    check("POSITION", "VEC3", 5125, false, false);
    check("TANGENT", "VEC3", 5126, false, false);
    check("TEXCOORD_0", "VEC3", 5126, false, false);
    check("JOINTS_0", "VEC4", 5126, false, false);
    check("WEIGHTS_0", "VEC4", 5122, true, false);
    check("_OWN", "SCALAR", 5125, false, true);
}

TEST_CASE("a quantised position is scaled by its node") {
    GltfBuilder builder = textured("{}");
    const int view = builder.view(std::vector<int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, 16384, 0, 0});
    builder.json["bufferViews"][view]["byteStride"] = 8;
    const int accessor = builder.accessor(view, 5122, 3, "VEC3");
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    builder.json["nodes"][0]["scale"] = {0.5, 0.5, 0.5};
    CHECK(load(builder).vertices[1].position == glm::vec3(16383.5f, 0, 0));
    CHECK(warnings(builder) ==
          "mesh 0 primitive 0 POSITION: UNDECLARED_EXTENSION: VEC3 of shorts need KHR_mesh_quantization, "
          "which extensionsUsed does not declare\n");
    builder.json["extensionsUsed"].push_back("KHR_mesh_quantization");
    CHECK(warnings(builder).empty());
    builder.json["accessors"][accessor]["normalized"] = true;
    CHECK(load(builder).vertices[1].position == glm::vec3(0.5f, 0, 0));
}
