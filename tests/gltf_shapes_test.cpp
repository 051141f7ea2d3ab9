// Meshes that stand several times (EXT_mesh_gpu_instancing), and those that move, at rest: morph targets and
// skins.
#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"
#include "tests/support/expect_error.h"
#include "tests/support/loaded_scene.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
const double kHalf = std::sqrt(0.5);

bool near(glm::vec3 a, glm::vec3 b) {
    return glm::length(a - b) < 1e-5f * (1.0f + glm::length(b));
}

std::string joined(const Scene& scene) {
    std::string all;
    for (const std::string& warning : scene.notes.warnings) all += warning + "\n";
    return all;
}

GltfBuilder oneTriangle(const Json& node = Json::object()) {
    GltfBuilder builder;
    const Json attributes{{"POSITION", builder.vec3(kTriangle)},
                          {"NORMAL", builder.vec3({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}})}};
    builder.mesh({{"attributes", attributes}}, node);
    return builder;
}

Json& attributesOf(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0]["attributes"];
}

// The triangle twice: there, and a quarter turn about +Z, twice as large, at (0, 0, 5).
GltfBuilder twice() {
    GltfBuilder builder = oneTriangle({{"translation", {10, 0, 0}}});
    const float h = static_cast<float>(kHalf);
    Json& attributes = builder.json["nodes"][0]["extensions"][kInstancing]["attributes"];
    attributes["TRANSLATION"] = builder.vec3({{0, 0, 0}, {0, 0, 5}});
    attributes["ROTATION"] = builder.vec4({{0, 0, 0, 1}, {0, 0, h, h}});
    attributes["SCALE"] = builder.vec3({{1, 1, 1}, {2, 2, 2}});
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {kInstancing};
    return builder;
}

} // namespace

TEST_CASE("instances of a node's mesh, moved, turned and scaled within the node") {
    GltfBuilder builder = twice();
    const Scene scene = load(builder);
    CHECK(joined(scene).empty());
    REQUIRE(scene.triangles.size() == 2);
    CHECK(corner(scene, 0, 1) == glm::vec3(11, 0, 0));
    CHECK(near(corner(scene, 1, 0), {10, 0, 5}));
    CHECK(near(corner(scene, 1, 1), {10, 2, 5}));
    CHECK(near(corner(scene, 1, 2), {8, 0, 5}));

    // A child of the node stands once; a camera or another mesh in it does not care.
    builder.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, -1}}});
    builder.json["nodes"][0]["children"] = {1};
    CHECK(load(builder).triangles.size() == 3);
    CHECK(corner(load(builder), 2, 0) == glm::vec3(10, 0, -1));
}

TEST_CASE("instances with some attributes, packed rotations, mirrors, and none at all") {
    GltfBuilder builder = twice();
    Json& attributes = builder.json["nodes"][0]["extensions"][kInstancing]["attributes"];
    attributes.erase("TRANSLATION");
    attributes["SCALE"] = builder.vec3({{1, 1, 1}, {-1, 1, 1}});
    attributes["ROTATION"] = builder.accessor(
        builder.view(std::vector<int16_t>{0, 0, 0, 32767, 0, 0, 23170, 23170}), 5122, 2, "VEC4");
    builder.json["accessors"][attributes["ROTATION"].get<size_t>()]["normalized"] = true;
    attributes["_OWN"] = builder.accessor(builder.view(std::vector<float>(2)), 5126, 2, "SCALAR");
    const Scene scene = load(builder);
    REQUIRE(scene.triangles.size() == 2);
    for (size_t t = 0; t < 2; ++t) CHECK(near(faceNormal(scene, t), {0, 0, 1}));
    CHECK(std::abs(corner(scene, 1, 1).x - 9) < 1e-4f); // (0, 1): turned after the mirror

    attributes = Json::object();
    CHECK(load(builder).triangles.size() == 1);
    builder.json["nodes"][0]["extensions"][kInstancing] = Json::object();
    CHECK(load(builder).triangles.size() == 1);
    builder.json["nodes"][0].erase("mesh"); // nothing stands several times
    CHECK(load(builder).triangles.empty());
}

TEST_CASE("instances that are broken, or too many") {
    const auto check = [](const std::string& sentence, const auto& spoil) {
        GltfBuilder builder = twice();
        spoil(builder, builder.json["nodes"][0]["extensions"][kInstancing]["attributes"]);
        expectError(ExitCode::BadData, sentence, [&] { load(builder); });
    };
    check("node 0 TRANSLATION: UNRESOLVED_REFERENCE: accessor 99 of",
          [](GltfBuilder&, Json& attributes) { attributes["TRANSLATION"] = 99; });
    check("attributes/TRANSLATION: TYPE_MISMATCH",
          [](GltfBuilder&, Json& attributes) { attributes["TRANSLATION"] = -1; });
    check("attributes/SCALE: VALUE_NOT_IN_RANGE",
          [](GltfBuilder&, Json& attributes) { attributes["SCALE"] = 1ull << 32; });
    check("INSTANCING_UNEQUAL_ACCESSOR_COUNT: 1 instances, another attribute has",
          [](GltfBuilder& builder, Json& attributes) {
              attributes["SCALE"] = builder.vec3({{1, 1, 1}});
          });
    check(
        "node 0 ROTATION: INSTANCING_ACCESSOR_INVALID_FORMAT: an accessor of another format is needed: VEC4",
        [](GltfBuilder& builder, Json& attributes) {
            attributes["ROTATION"] = builder.vec3({{1, 1, 1}, {1, 1, 1}});
        });
    check("node 0 SCALE: INSTANCING_ACCESSOR_INVALID_FORMAT: an accessor of another format is needed: VEC3",
          [](GltfBuilder& builder, Json& attributes) {
              attributes["SCALE"] = builder.accessor(builder.view(std::vector<int16_t>(8)), 5122, 2, "VEC3");
          });
    check("triangles allowed", [](GltfBuilder& builder, Json& attributes) { // 2^24 instances of 3 triangles
        builder.json["meshes"][0]["primitives"][0]["indices"] = builder.indices({0, 1, 2, 0, 1, 2, 0, 1, 2});
        builder.json["accessors"].push_back({{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}});
        const size_t last = builder.json["accessors"].size() - 1;
        attributes = {{"TRANSLATION", last}};
    });
}

TEST_CASE("instances of a mesh without triangles cost nothing") {
    GltfBuilder builder = twice();
    builder.json["accessors"].push_back({{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}});
    builder.json["nodes"][0]["extensions"][kInstancing]["attributes"] = {
        {"SCALE", builder.json["accessors"].size() - 1}};
    builder.json["meshes"][0]["primitives"][0]["mode"] = 0;
    CHECK(load(builder).triangles.empty());
}

// ---- morph targets

namespace {

// Two targets: up by 1, and turned so that the normal is +X.
GltfBuilder morphed() {
    GltfBuilder builder = oneTriangle();
    const Json up{{"POSITION", builder.vec3(std::vector<glm::vec3>(3, {0, 1, 0}))}};
    const Json turned{{"POSITION", builder.vec3({{0, 0, 0}, {-1, 0, -1}, {0, 0, 0}})},
                      {"NORMAL", builder.vec3(std::vector<glm::vec3>(3, {1, 0, -1}))}};
    builder.json["meshes"][0]["primitives"][0]["targets"] = {up, turned};
    return builder;
}

const std::string kMorphNote = "morph targets stand at rest, at the weights of their meshes and nodes\n";

} // namespace

TEST_CASE("morph targets at the mesh's weights, or the node's own") {
    GltfBuilder builder = morphed();
    CHECK(corner(load(builder), 0, 1) == glm::vec3(1, 0, 0)); // weights of 0
    builder.json["meshes"][0]["weights"] = {0.5, 0};
    CHECK(corner(load(builder), 0, 1) == glm::vec3(1, 0.5f, 0));
    CHECK(joined(load(builder)) == kMorphNote);
    builder.root({{"mesh", 0}, {"weights", {0, 1}}});
    builder.root({{"mesh", 0}});
    const Scene scene = load(builder);
    REQUIRE(scene.triangles.size() == 3);
    CHECK(corner(scene, 0, 1) == glm::vec3(1, 0.5f, 0));
    CHECK(corner(scene, 1, 1) == glm::vec3(0, 0, -1));
    CHECK(near(scene.vertices[scene.triangles[1].vertex.x].normal, {1, 0, 0}));
    CHECK(corner(scene, 2, 1) == glm::vec3(1, 0.5f, 0));
    CHECK(near(faceNormal(scene, 1), {1, 0, 0}));
    CHECK(joined(scene) == kMorphNote); // once
}

TEST_CASE("morph targets move tangents, and flat normals follow positions") {
    GltfBuilder builder = morphed();
    builder.json["meshes"][0]["weights"] = {0, 1};
    attributesOf(builder).erase("NORMAL");
    const Scene flat = load(builder);
    CHECK(near(flat.vertices[0].normal, {1, 0, 0}));

    builder = morphed();
    builder.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    builder.json["textures"] = {{{"source", 0}}};
    const std::string png =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
    builder.json["images"] = {{{"uri", "data:image/png;base64," + png}}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    attributesOf(builder)["TEXCOORD_0"] = builder.vec2(kTriangleUv);
    attributesOf(builder)["TANGENT"] = builder.vec4(std::vector<glm::vec4>(3, {1, 0, 0, -1}));
    builder.json["meshes"][0]["primitives"][0]["targets"][0]["TANGENT"] =
        builder.vec3(std::vector<glm::vec3>(3, {-1, 1, 0}));
    CHECK(load(builder).vertices[0].tangent == glm::vec4(1, 0, 0, -1));
    builder.json["meshes"][0]["weights"] = {1, 0};
    CHECK(near(load(builder).vertices[0].tangent, {0, 1, 0}));
    CHECK(load(builder).vertices[0].tangent.w == -1.0f);
}

TEST_CASE("broken morph targets") {
    const auto check = [](const std::string& sentence, const auto& spoil) {
        GltfBuilder builder = morphed();
        spoil(builder, builder.json["meshes"][0]);
        expectError(ExitCode::BadData, sentence, [&] { load(builder); });
    };
    check("mesh 0: MESH_INVALID_WEIGHTS_COUNT: 1 weights for 2 morph targets",
          [](GltfBuilder&, Json& mesh) { mesh["weights"] = {1}; });
    check("node 0: NODE_WEIGHTS_INVALID: 3 weights for 2 morph targets", [](GltfBuilder& builder, Json&) {
        builder.json["nodes"][0]["weights"] = {1, 2, 3};
    });
    check("POSITION: MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT: 2 for 3 positions",
          [](GltfBuilder& builder, Json& mesh) {
              mesh["primitives"][0]["targets"][0]["POSITION"] = builder.vec3({{0, 0, 0}, {0, 0, 0}});
          });
    check("POSITION: UNRESOLVED_REFERENCE: accessor 77",
          [](GltfBuilder&, Json& mesh) { mesh["primitives"][0]["targets"][0]["POSITION"] = 77; });
    check("INVALID_FORMAT", [](GltfBuilder& builder, Json& mesh) {
        mesh["primitives"][0]["targets"][0]["POSITION"] = builder.vec2({{0, 0}, {0, 0}, {0, 0}});
    });
    check("MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT: 2 and 0 morph targets", [](GltfBuilder&, Json& mesh) {
        Json second = mesh["primitives"][0];
        second.erase("targets");
        mesh["primitives"].push_back(second);
    });
}

// ---- skins

namespace {

// The triangle's corners on three joints: the first about the origin, the second a quarter turn about +Z at
// (5, 0, 0), the third halfway between both. The node that shows it is elsewhere, and does not count.
GltfBuilder skinned() {
    GltfBuilder builder = oneTriangle({{"skin", 0}, {"translation", {100, 0, 0}}});
    attributesOf(builder)["JOINTS_0"] = builder.accessor(
        builder.view(std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), 5121, 3, "VEC4");
    attributesOf(builder)["WEIGHTS_0"] = builder.vec4({{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}});
    builder.root(Json::object());
    builder.root({{"translation", {5, 0, 0}}, {"rotation", {0, 0, kHalf, kHalf}}});
    builder.json["skins"] = {{{"joints", {1, 2}}}};
    return builder;
}

int matrices(GltfBuilder& builder, const std::vector<glm::mat4>& values) {
    return builder.accessor(builder.view(values), 5126, values.size(), "MAT4");
}

} // namespace

TEST_CASE("a skin holds its mesh where its joints are") {
    GltfBuilder builder = skinned();
    const Scene scene = load(builder);
    CHECK(joined(scene) == "skins stand at rest, at the transforms of their joints\n");
    CHECK(near(corner(scene, 0, 0), {0, 0, 0}));
    CHECK(near(corner(scene, 0, 1), {5, 1, 0}));    // (1, 0, 0) turned
    CHECK(near(corner(scene, 0, 2), {2, 0.5f, 0})); // half of (0, 1, 0) and of (4, 0, 0)
    for (const Vertex& vertex : scene.vertices) CHECK(near(vertex.normal, {0, 0, 1}));

    // Weights count relative to their sum; bad ones not at all.
    attributesOf(builder)["WEIGHTS_0"] =
        builder.vec4({{0, 0, 0, 0}, {3, -1, 0, 0}, {0.25f, 0.25f, std::nanf(""), 0}});
    const Scene scaled = load(builder);
    CHECK(
        joined(scaled) ==
        "skins stand at rest, at the transforms of their joints\n"
        "mesh 0 primitive 0: ACCESSOR_INVALID_FLOAT: weights of joints that are negative or not finite are "
        "taken as 0\n"
        "mesh 0 primitive 0: ACCESSOR_WEIGHTS_NON_NORMALIZED: vertices without a weight above 0 hang on the "
        "skin's first joint\n");
    for (int c = 0; c < 3; ++c) CHECK(near(corner(scaled, 0, c), corner(scene, 0, c)));

    // The inverse matrices put the mesh into the joint's space.
    glm::mat4 moved(1.0f);
    moved[3] = glm::vec4(0, 0, 7, 1);
    builder.json["skins"][0]["inverseBindMatrices"] = matrices(builder, {moved, glm::mat4(1.0f)});
    CHECK(near(corner(load(builder), 0, 0), {0, 0, 7}));
    CHECK(near(corner(load(builder), 0, 1), {5, 1, 0}));
}

TEST_CASE("eight joints a vertex, and joints with indices of two bytes") {
    GltfBuilder builder = skinned();
    attributesOf(builder)["JOINTS_0"] =
        builder.accessor(builder.view(std::vector<uint16_t>(12, 0)), 5123, 3, "VEC4");
    attributesOf(builder)["JOINTS_1"] =
        builder.accessor(builder.view(std::vector<uint16_t>(12, 1)), 5123, 3, "VEC4");
    attributesOf(builder)["WEIGHTS_0"] = builder.vec4(std::vector<glm::vec4>(3, {0.5f, 0, 0, 0}));
    attributesOf(builder)["WEIGHTS_1"] = builder.vec4(std::vector<glm::vec4>(3, {0, 0, 0, 0.5f}));
    CHECK(near(corner(load(builder), 0, 2), {2, 0.5f, 0}));
    const int packed = builder.accessor(
        builder.view(std::vector<uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}), 5121, 3, "VEC4");
    builder.json["accessors"][packed]["normalized"] = true;
    attributesOf(builder)["WEIGHTS_0"] = attributesOf(builder)["WEIGHTS_1"] = packed;
    CHECK(near(corner(load(builder), 0, 2), {2, 0.5f, 0}));
}

TEST_CASE("joints that mirror, scale and stand far away") {
    GltfBuilder builder = skinned();
    for (const int joint : {1, 2}) builder.json["nodes"][joint] = {{"scale", {-2, 1, 1}}};
    const Scene mirrored = load(builder);
    CHECK(near(corner(mirrored, 0, 0), {0, 0, 0}));
    CHECK(near(faceNormal(mirrored, 0), {0, 0, 1}));
    CHECK(near(mirrored.vertices[0].normal, {0, 0, 1}));

    for (const int joint : {1, 2}) builder.json["nodes"][joint] = {{"translation", {1e7, 0.25, 0}}};
    const Scene far = load(builder);
    const auto& first = far.triangles[0].vertex;
    CHECK(far.vertices[first.y].position - far.vertices[first.x].position == glm::vec3(1, 0, 0));
    CHECK(far.origin.x > 9e6);
}

TEST_CASE("two nodes with skins of their own show one mesh in two poses") {
    GltfBuilder builder = skinned();
    builder.json["skins"].push_back({{"joints", {2, 2}}});
    builder.root({{"mesh", 0}, {"skin", 1}});
    const Scene scene = load(builder);
    REQUIRE(scene.triangles.size() == 2);
    CHECK(near(corner(scene, 0, 0), {0, 0, 0}));
    CHECK(near(corner(scene, 1, 0), {5, 0, 0}));
    CHECK(near(corner(scene, 1, 2), {4, 0, 0}));
    CHECK(scene.notes.warnings.size() == 1);
}

TEST_CASE("broken skins") {
    const auto check = [](const std::string& sentence, const auto& spoil) {
        GltfBuilder builder = skinned();
        spoil(builder, builder.json["skins"][0]);
        expectError(ExitCode::BadData, sentence, [&] { load(builder); });
    };
    check("skin 0: UNRESOLVED_REFERENCE: node 9 of 3", [](GltfBuilder&, Json& skin) {
        skin["joints"] = {1, 9};
    });
    check("skin 0: EMPTY_ENTITY", [](GltfBuilder&, Json& skin) { skin["joints"] = Json::array(); });
    check("node 0: UNRESOLVED_REFERENCE: skin 4 of 1",
          [](GltfBuilder& builder, Json&) { builder.json["nodes"][0]["skin"] = 4; });
    check("skin 0: INVALID_IBM_ACCESSOR_COUNT: 1 matrices for 2 joints",
          [](GltfBuilder& builder, Json& skin) {
              skin["inverseBindMatrices"] = matrices(builder, {glm::mat4(1.0f)});
          });
    check("skin 0: SKIN_IBM_INVALID_FORMAT",
          [](GltfBuilder&, Json& skin) { skin["inverseBindMatrices"] = 0; });
    check("mesh 0 primitive 0: ACCESSOR_JOINTS_INDEX_OOB: vertex 1 hangs on joint 1 of 1",
          [](GltfBuilder&, Json& skin) { skin["joints"] = {1}; });
    check("MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH",
          [](GltfBuilder& builder, Json&) { attributesOf(builder).erase("WEIGHTS_0"); });
    check("JOINTS_0: MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", [](GltfBuilder& builder, Json&) {
        attributesOf(builder)["JOINTS_0"] = attributesOf(builder)["WEIGHTS_0"];
    });
}
