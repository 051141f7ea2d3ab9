// Scenes that are well formed: geometry, transforms, materials, cameras, environments.
#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"
#include "tests/support/loaded_scene.h"
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <glm/gtc/constants.hpp>

using namespace irradia;
using namespace irradia::test;
using Catch::Matchers::ContainsSubstring;

namespace {

// Float positions and unit vectors of small scenes: a few rounding errors.
bool near(glm::vec3 a, glm::vec3 b) {
    return glm::length(a - b) < 1e-6f * (1.0f + glm::length(b));
}

GltfBuilder oneTriangle(const Json& node = Json::object()) {
    GltfBuilder builder;
    builder.mesh({{"attributes", {{"POSITION", builder.vec3(kTriangle)}}}}, node);
    return builder;
}

std::string joined(const SceneNotes& notes) {
    std::string text;
    for (const std::string& warning : notes.warnings) text += warning + "\n";
    return text;
}

} // namespace

TEST_CASE("A triangle without normals has the flat normal and the default material") {
    const Scene scene = load(oneTriangle());
    REQUIRE(scene.triangles.size() == 1);
    REQUIRE(scene.vertices.size() == 3);
    CHECK(corner(scene, 0, 1) == kTriangle[1]);
    for (const Vertex& vertex : scene.vertices) CHECK(vertex.normal == glm::vec3(0, 0, 1));
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].metallic == 1.0f);
    CHECK(scene.materials[0].roughness == 1.0f);
    CHECK(scene.notes.warnings.empty());
    CHECK(scene.name == "scene");
}

TEST_CASE("Flat normals unshare vertices, given normals share them and become unit") {
    const std::vector<glm::vec3> tent{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    const std::vector<uint16_t> faces{0, 1, 2, 0, 3, 1};
    GltfBuilder flat;
    flat.mesh({{"attributes", {{"POSITION", flat.vec3(tent)}}}, {"indices", flat.indices(faces)}});
    const Scene a = load(flat);
    CHECK(a.vertices.size() == 6);
    for (size_t t = 0; t < 2; ++t)
        for (int c = 0; c < 3; ++c)
            CHECK(near(a.vertices[a.triangles[t].vertex[c]].normal, faceNormal(a, t)));

    GltfBuilder smooth;
    const std::vector<glm::vec3> normals{{0, 3, 4}, {0, 0, 0.1f}, {0, 0, 2}, {0, 0, 0}};
    smooth.mesh({{"attributes", {{"POSITION", smooth.vec3(tent)}, {"NORMAL", smooth.vec3(normals)}}},
                 {"indices", smooth.indices(faces)}});
    const Scene b = load(smooth);
    CHECK(b.vertices.size() == 4);
    CHECK(near(b.vertices[b.triangles[0].vertex[0]].normal, {0, 0.6f, 0.8f}));
    CHECK(near(b.vertices[b.triangles[0].vertex[1]].normal, {0, 0, 1}));
    CHECK(near(b.vertices[b.triangles[1].vertex[1]].normal, faceNormal(b, 1))); // a zero normal: the flat one
}

TEST_CASE("Nodes: matrix, translation-rotation-scale and hierarchy") {
    const double h = std::sqrt(0.5);
    // Quarter turn about +Z, twice as large, moved: (x, y) -> (10 - 2 y, 2 x).
    const Json trs{{"translation", {10, 0, 0}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 2, 2}}};
    const Json matrix{{"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}};
    for (const Json& node : {trs, matrix}) {
        const Scene scene = load(oneTriangle(node));
        CHECK(near(corner(scene, 0, 0), {10, 0, 0}));
        CHECK(near(corner(scene, 0, 1), {10, 2, 0}));
        CHECK(near(corner(scene, 0, 2), {8, 0, 0}));
    }

    GltfBuilder family = oneTriangle();
    family.json["nodes"] = {{{"children", {1}}, {"translation", {0, 0, 5}}},
                            {{"mesh", 0}, {"scale", {3, 3, 3}}}};
    CHECK(near(corner(load(family), 0, 1), {3, 0, 5}));
}

TEST_CASE("Nodes that share a mesh are instances; only the default scene counts") {
    GltfBuilder builder = oneTriangle();
    builder.root({{"mesh", 0}, {"translation", {0, 0, 7}}});
    builder.json["nodes"].push_back({{"mesh", 0}}); // in no scene
    const Scene scene = load(builder);
    REQUIRE(scene.triangles.size() == 2);
    CHECK(corner(scene, 1, 1) == glm::vec3(1, 0, 7));

    builder.json["scenes"].push_back({{"nodes", {2}}});
    builder.json["scene"] = 1;
    CHECK(load(builder).triangles.size() == 1);
    builder.json.erase("scene"); // the first scene then
    CHECK(load(builder).triangles.size() == 2);
}

TEST_CASE("A mirroring node flips the winding, so normals, faces and tangents agree") {
    GltfBuilder builder;
    const Json attributes{{"POSITION", builder.vec3(kTriangle)},
                          {"NORMAL", builder.vec3({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}})}};
    builder.mesh({{"attributes", attributes}}, {{"scale", {-2, 1, 1}}});
    const Scene scene = load(builder);
    CHECK(near(faceNormal(scene, 0), {0, 0, 1}));
    CHECK(near(scene.vertices[0].normal, {0, 0, 1}));
    CHECK(sceneBounds(scene).lower == glm::vec3(-2, 0, 0));
}

TEST_CASE("Normals go by the inverse transpose") {
    // A 45 degree slope, x + z = 1, stretched by 3 along x: x/3 + z = 1, whose normal is (1/3, 0, 1) /
    // length.
    GltfBuilder builder;
    const float h = std::sqrt(0.5f);
    const Json attributes{{"POSITION", builder.vec3({{1, 0, 0}, {1, 1, 0}, {0, 0, 1}})},
                          {"NORMAL", builder.vec3({{h, 0, h}, {h, 0, h}, {h, 0, h}})}};
    builder.mesh({{"attributes", attributes}}, {{"scale", {3, 1, 1}}});
    const Scene scene = load(builder);
    CHECK(near(scene.vertices[0].normal, glm::normalize(glm::vec3(1.0f / 3, 0, 1))));
    CHECK(near(scene.vertices[0].normal, faceNormal(scene, 0)));
}

TEST_CASE("Strips, fans and other modes") {
    const std::vector<glm::vec3> quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    GltfBuilder strip;
    strip.mesh({{"attributes", {{"POSITION", strip.vec3(quad)}}}, {"mode", 5}});
    const Scene a = load(strip);
    REQUIRE(a.triangles.size() == 2);
    for (size_t t = 0; t < 2; ++t) CHECK(near(faceNormal(a, t), {0, 0, 1}));

    GltfBuilder fan;
    fan.mesh({{"attributes", {{"POSITION", fan.vec3(quad)}}},
              {"indices", fan.indices({0, 1, 3, 2})},
              {"mode", 6}});
    const Scene b = load(fan);
    REQUIRE(b.triangles.size() == 2);
    for (size_t t = 0; t < 2; ++t) CHECK(near(faceNormal(b, t), {0, 0, 1}));

    GltfBuilder lines = oneTriangle();
    lines.mesh({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    const Scene c = load(lines);
    CHECK(c.triangles.size() == 1);
    CHECK_THAT(joined(c.notes), ContainsSubstring("points and lines"));
}

TEST_CASE("Accessors: sparse, strided, normalised, every index type") {
    SECTION("sparse over data and sparse over zeros") {
        GltfBuilder builder = oneTriangle();
        const int index = builder.view(std::vector<uint16_t>{1});
        const int value = builder.view(std::vector<glm::vec3>{{5, 0, 0}});
        const Json sparse{{"count", 1},
                          {"indices", {{"bufferView", index}, {"componentType", 5123}}},
                          {"values", {{"bufferView", value}}}};
        builder.json["accessors"][0]["sparse"] = sparse;
        CHECK(corner(load(builder), 0, 1) == glm::vec3(5, 0, 0));
        CHECK(corner(load(builder), 0, 2) == glm::vec3(0, 1, 0));

        builder.json["accessors"][0].erase("bufferView"); // (0, 0, 0), (5, 0, 0), (0, 0, 0)
        CHECK(load(builder).notes.degenerateTriangles == 1);
    }
    SECTION("interleaved") {
        GltfBuilder builder;
        const int view = builder.view(
            std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 2}, {1, 0, 0}, {0, 0, 2}, {0, 1, 0}, {0, 0, 2}});
        builder.json["bufferViews"][view]["byteStride"] = 24;
        const int position = builder.accessor(view, 5126, 3, "VEC3"),
                  normal = builder.accessor(view, 5126, 3, "VEC3");
        builder.json["accessors"][normal]["byteOffset"] = 12;
        builder.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
        const Scene scene = load(builder);
        CHECK(corner(scene, 0, 2) == glm::vec3(0, 1, 0));
        CHECK(scene.vertices[2].normal == glm::vec3(0, 0, 1));
    }
    SECTION("normalised integers") {
        const auto uvOf = [](int type, const auto& values) {
            GltfBuilder builder;
            const int uv = builder.accessor(builder.view(values), type, 3, "VEC2");
            builder.json["accessors"][uv]["normalized"] = true;
            builder.mesh({{"attributes", {{"POSITION", builder.vec3(kTriangle)}, {"TEXCOORD_0", uv}}}});
            return load(builder).vertices[1].uv[0];
        };
        CHECK(uvOf(5121, std::vector<uint8_t>{0, 0, 255, 51, 0, 0}) == glm::vec2(1.0f, 51.0f / 255));
        CHECK(uvOf(5123, std::vector<uint16_t>{0, 0, 65535, 13107, 0, 0}) ==
              glm::vec2(1.0f, 13107.0f / 65535));
        CHECK(uvOf(5120, std::vector<int8_t>{0, 0, -128, 127, 0, 0}) == glm::vec2(-1.0f, 1.0f));
        CHECK(uvOf(5122, std::vector<int16_t>{0, 0, -32768, 32767, 0, 0}) == glm::vec2(-1.0f, 1.0f));
    }
    SECTION("indices of 1, 2 and 4 bytes") {
        const auto lastCorner = [](int type, const auto& values) {
            GltfBuilder builder;
            const int indices = builder.accessor(builder.view(values), type, 3, "SCALAR");
            builder.mesh({{"attributes", {{"POSITION", builder.vec3(kTriangle)}}}, {"indices", indices}});
            return corner(load(builder), 0, 2);
        };
        CHECK(lastCorner(5121, std::vector<uint8_t>{1, 2, 0}) == kTriangle[0]);
        CHECK(lastCorner(5123, std::vector<uint16_t>{1, 2, 0}) == kTriangle[0]);
        CHECK(lastCorner(5125, std::vector<uint32_t>{1, 2, 0}) == kTriangle[0]);
    }
}

TEST_CASE("Triangles that are not finite or have no area are dropped and counted") {
    const float nan = std::nanf("");
    GltfBuilder builder;
    const std::vector<glm::vec3> points{{0, 0, 0},   {1, 0, 0}, {0, 1, 0},
                                        {nan, 0, 0}, {2, 0, 0}, {1e-5f, 1, 0}};
    builder.mesh({{"attributes", {{"POSITION", builder.vec3(points)}}},
                  {"indices", builder.indices({0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 1, 2, 0, 5, 2})}});
    const Scene scene = load(builder);
    CHECK(scene.triangles.size() == 2); // the first, and the last: a sliver, but with area
    CHECK(scene.notes.nonFiniteTriangles == 1);
    CHECK(scene.notes.degenerateTriangles == 2);
    for (const Vertex& vertex : scene.vertices) CHECK(std::isfinite(vertex.position.x));
}

namespace {

// A triangle with a 2 x 1 picture beside the file, as every texture of one material.
struct TexturedTriangle {
    TempFolder folder;
    GltfBuilder builder;

    TexturedTriangle() {
        writePng(folder / "two pixels.png", {2, 1, {255, 0, 0, 255, 0, 0, 255, 128}});
        builder.json["images"] = {{{"uri", "two%20pixels.png"}}};
        builder.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
        builder.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
        builder.json["materials"] = {Json::object()};
        const Json attributes{{"POSITION", builder.vec3(kTriangle)},
                              {"TEXCOORD_0", builder.vec2(kTriangleUv)},
                              {"TEXCOORD_1", builder.vec2({{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}})}};
        builder.mesh({{"attributes", attributes}, {"material", 0}});
    }

    Json& material() { return builder.json["materials"][0]; }
    Json& attributes() { return builder.json["meshes"][0]["primitives"][0]["attributes"]; }
    Scene load() const { return loadScene(folder.write("scene.glb", builder.glb())); }
};

} // namespace

TEST_CASE("Material fields, texture slots, wrap modes and coordinate sets") {
    TexturedTriangle scene;
    scene.material() = Json::parse(R"({"name": "all", "doubleSided": true, "emissiveFactor": [0.5, 1, 0],
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0.4, "roughnessFactor": 0.6,
            "baseColorTexture": {"index": 0, "texCoord": 1}, "metallicRoughnessTexture": {"index": 1}},
        "normalTexture": {"index": 1, "scale": 0.7}, "emissiveTexture": {"index": 1},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8},
            "KHR_materials_ior": {"ior": 1.3},
            "KHR_materials_specular": {"specularFactor": 0.9, "specularColorFactor": [0.5, 1, 2],
                "specularTexture": {"index": 1, "texCoord": 1}, "specularColorTexture": {"index": 0}}}})");
    scene.builder.json["extensionsUsed"] = {"KHR_materials_emissive_strength", "KHR_materials_ior",
                                            "KHR_materials_specular"};
    const Scene loaded = scene.load();
    const Material& material = loaded.materials.at(0);
    CHECK(material.name == "all");
    CHECK(material.doubleSided);
    CHECK(material.baseColor == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(material.metallic == 0.4f);
    CHECK(material.roughness == 0.6f);
    CHECK(material.normalScale == 0.7f);
    CHECK(material.emission == glm::vec3(4, 8, 0));
    CHECK(material.ior == 1.3f);
    CHECK(material.specular == 0.9f);
    CHECK(material.specularColor == glm::vec3(0.5f, 1, 2));

    CHECK(material.baseColorTexture.image == 0);
    CHECK(material.baseColorTexture.uvSet == 1);
    CHECK(material.baseColorTexture.wrapS == Wrap::ClampToEdge);
    CHECK(material.baseColorTexture.wrapT == Wrap::MirroredRepeat);
    CHECK(material.metallicRoughnessTexture.uvSet == 0);
    CHECK(material.metallicRoughnessTexture.wrapS == Wrap::Repeat);
    for (const TextureRef& ref :
         {material.metallicRoughnessTexture, material.normalTexture, material.emissiveTexture,
          material.specularTexture, material.specularColorTexture})
        CHECK(ref.image == 0);
    CHECK(material.specularTexture.uvSet == 1);

    REQUIRE(loaded.images.size() == 1); // decoded once for six uses
    CHECK(loaded.images[0].width == 2);
    CHECK(loaded.images[0].rgba == std::vector<uint8_t>{255, 0, 0, 255, 0, 0, 255, 128});
    CHECK(loaded.vertices[1].uv[0] == kTriangleUv[1]);
    CHECK(loaded.vertices[2].uv[1] == glm::vec2(0.5f, 0.6f));
    CHECK(loaded.notes.warnings.empty());
}

TEST_CASE("Pictures are found in buffer views and data URIs too; unused ones are not read") {
    TexturedTriangle scene;
    scene.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    std::ifstream png(scene.folder / "two pixels.png", std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(png), {}};
    scene.builder.json["images"] = {{{"uri", "missing.png"}},
                                    {{"bufferView", scene.builder.view(bytes)}, {"mimeType", "image/png"}}};
    scene.builder.json["textures"] = {{{"source", 1}}};
    const Scene loaded = scene.load();
    REQUIRE(loaded.images.size() == 1);
    CHECK(loaded.images[0].rgba[6] == 255);
}

TEST_CASE("Material values out of range are clamped with a warning") {
    TexturedTriangle scene;
    scene.material() = Json::parse(R"({"name": "odd", "pbrMetallicRoughness": {"metallicFactor": -3}})");
    const Scene loaded = scene.load();
    CHECK(loaded.materials.at(0).metallic == 0.0f);
    CHECK_THAT(joined(loaded.notes), ContainsSubstring("material 0 'odd': metallicFactor -3"));
}

TEST_CASE("Specular-glossiness becomes a dielectric with F0 = specular colour") {
    TexturedTriangle scene;
    scene.material() = Json::parse(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [0.5, 0.25, 1, 1], "specularFactor": [0.2, 0.3, 0.4], "glossinessFactor": 0.75}}})");
    const Material material = scene.load().materials.at(0);
    CHECK(material.baseColor == glm::vec3(0.5f, 0.25f, 1));
    CHECK(material.roughness == 0.25f);
    CHECK(material.metallic == 0.0f);
    CHECK(material.specularColor == glm::vec3(0.2f, 0.3f, 0.4f));
    CHECK(material.ior == 0.0f); // ((0 - 1) / (0 + 1))^2 = 1
}

TEST_CASE("Tangents: made for normal maps, along +u, up against v") {
    TexturedTriangle scene;
    scene.material()["normalTexture"]["index"] = 0;
    SECTION("from texture coordinates") {
        const Scene loaded = scene.load();
        CHECK(near(loaded.vertices[0].tangent, {1, 0, 0}));
        CHECK(loaded.vertices[0].tangent.w == 1.0f); // cross(+Z, +X) = +Y: up in the picture
    }
    SECTION("mirrored texture coordinates turn the handedness") {
        scene.attributes()["TEXCOORD_0"] = scene.builder.vec2({{1, 1}, {0, 1}, {1, 0}});
        const Scene loaded = scene.load();
        CHECK(near(loaded.vertices[0].tangent, {-1, 0, 0}));
        CHECK(loaded.vertices[0].tangent.w == -1.0f);
    }
    SECTION("the file's own win, orthonormalised, and a mirroring node turns them") {
        scene.attributes()["NORMAL"] = scene.builder.vec3({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
        const glm::vec4 tilted(0, 3, 4, 1);
        scene.attributes()["TANGENT"] = scene.builder.vec4({tilted, tilted, tilted});
        CHECK(scene.load().vertices[0].tangent == glm::vec4(0, 1, 0, 1));
        scene.builder.json["nodes"][0]["scale"] = {1, -1, 1};
        CHECK(scene.load().vertices[0].tangent == glm::vec4(0, -1, 0, -1));
    }
    SECTION("sides of a mirrored seam get vertices of their own") {
        scene.builder.json["meshes"][0]["primitives"][0] = {
            {"attributes",
             {{"POSITION", scene.builder.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}})},
              {"NORMAL", scene.builder.vec3(std::vector<glm::vec3>(4, {0, 0, 1}))},
              {"TEXCOORD_0", scene.builder.vec2({{0, 1}, {1, 1}, {0, 0}, {1, 1}})}}},
            {"indices", scene.builder.indices({0, 1, 2, 0, 2, 3})},
            {"material", 0}};
        const Scene loaded = scene.load();
        CHECK(loaded.vertices.size() == 6);
        for (int c = 0; c < 3; ++c) {
            CHECK(near(loaded.vertices[loaded.triangles[0].vertex[c]].tangent, {1, 0, 0}));
            CHECK(near(loaded.vertices[loaded.triangles[1].vertex[c]].tangent, {-1, 0, 0}));
            CHECK(loaded.vertices[loaded.triangles[1].vertex[c]].tangent.w == -1.0f);
        }
    }
    SECTION("none without a normal map") {
        scene.material() = Json::object();
        CHECK(scene.load().vertices[0].tangent == glm::vec4(0.0f));
    }
}

TEST_CASE("Cameras: world transform without scale, perspective and orthographic") {
    GltfBuilder builder = oneTriangle();
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}},
        {{"type", "orthographic"},
         {"name", "flat"},
         {"orthographic", {{"xmag", 1}, {"ymag", 3}, {"znear", 0}, {"zfar", 1}}}}};
    const double h = std::sqrt(0.5);
    builder.root(
        {{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}, {"scale", {5, 2, 9}}});
    builder.root({{"camera", 1}});
    const Scene scene = load(builder);
    REQUIRE(scene.cameras.size() == 2);
    const Camera& camera = scene.cameras[0];
    CHECK(camera.name == "eye");
    CHECK(camera.position == glm::vec3(1, 2, 3));
    CHECK(near(camera.forward, {-1, 0, 0})); // -Z a quarter turn about +Y
    CHECK(near(camera.up, {0, 1, 0}));
    CHECK(camera.verticalFov == 0.8f);
    CHECK_FALSE(camera.isOrthographic());
    CHECK(scene.cameras[1].isOrthographic());
    CHECK(scene.cameras[1].halfHeight == 3.0f);
    CHECK(joined(scene.notes).empty());

    CHECK(chooseCamera(scene, "").camera.name == "eye");
    CHECK(chooseCamera(scene, "eye").camera.position == camera.position);
    CHECK(chooseCamera(scene, "0").camera.name == "eye");
    CHECK(chooseCamera(scene, "flat").camera.isOrthographic());
    CHECK_THROWS_AS(chooseCamera(scene, "2"), Error);
    CHECK_THROWS_AS(chooseCamera(scene, "ear"), Error);
    Scene several;
    several.name = "room";
    several.cameras.resize(20);
    several.cameras[1].name = "door";
    CHECK(chooseCamera(several, "19").camera.name.empty());
    CHECK_THROWS_WITH(chooseCamera(several, "20"),
                      "camera '20': the scene 'room' has camera 0, 1 'door', 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, "
                      "12, 13, 14, 15 and 4 more");
}

TEST_CASE("A scene without a camera is framed: every corner falls inside the picture") {
    const Scene scene = load(oneTriangle({{"scale", {40, 3, 3}}, {"translation", {-100, 7, 0}}}));
    const Camera camera = chooseCamera(scene, "").camera;
    const Bounds bounds = sceneBounds(scene);
    CHECK(scene.origin + glm::dvec3(bounds.lower) == glm::dvec3(-100, 7, 0));
    CHECK(scene.origin + glm::dvec3(bounds.upper) == glm::dvec3(-60, 10, 0));
    CHECK(std::abs(glm::dot(camera.forward, camera.up)) < 1e-6f);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 point = glm::mix(bounds.lower, bounds.upper, glm::vec3(i & 1, i >> 1 & 1, i >> 2));
        const glm::vec3 ray = glm::normalize(point - camera.position);
        CHECK(glm::dot(ray, camera.forward) > std::cos(0.5f * camera.verticalFov));
    }
}

TEST_CASE("Camera files name a camera and an environment beside them") {
    const TempFolder folder;
    const std::string camera =
        R"("camera": {"position": [1, 2, 3], "look_at": [1, 2, -4], "up": [0, 5, 1], "vfov_deg": 60, "aspect": 1},
           "source": "somewhere")";
    const CameraFile file =
        loadCameraFile(folder.write("a.json", "{" + camera + R"(, "env": "sky/day.hdr"})"));
    CHECK(file.camera.position == glm::vec3(1, 2, 3));
    CHECK(file.camera.forward == glm::vec3(0, 0, -1));
    CHECK(near(file.camera.up, {0, 1, 0}));
    CHECK(file.camera.verticalFov == Catch::Approx(glm::pi<float>() / 3));
    CHECK(file.environment == (folder / "sky/day.hdr").string());

    CHECK(loadCameraFile(folder.write("b.json", "{" + camera + R"(, "env": null})")).environment.empty());
    CHECK(loadCameraFile(folder.write("c.json", "{" + camera + "}")).environment.empty());
    const auto constant =
        loadCameraFile(folder.write("d.json", "{" + camera + R"(, "env": [0.5, 1, 2e-3]})"));
    CHECK(loadEnvironment(constant.environment).constant == glm::vec3(0.5f, 1, 2e-3f));
    CHECK(chooseCamera({}, (folder / "a.json").string()).camera.name == "a");
}

TEST_CASE("Environments: constants, EXR and HDR pictures") {
    CHECK(loadEnvironment("0.5,1, 2").constant == glm::vec3(0.5f, 1, 2));
    CHECK(loadEnvironment("0,0,0").isBlack());

    const TempFolder folder;
    LayeredImage image;
    image.width = 2;
    image.height = 1;
    image.setRgb("", std::vector<glm::vec3>{{1, 2, 3}, {-0.5f, 0.25f, 70000}});
    writeExr(folder / "sky.EXR", image);
    const Environment sky = loadEnvironment((folder / "sky.EXR").string());
    CHECK(sky.width == 2);
    CHECK(sky.height == 1);
    CHECK(sky.texels == std::vector<glm::vec3>{{1, 2, 3}, {0, 0.25f, 70000}});
}

TEST_CASE("The content hash is FNV-1a of the file's bytes") {
    // The hash of a file that ends in 'a' follows from the one without it.
    const TempFolder folder;
    const std::string glb = oneTriangle().glb();
    const uint64_t hash = loadScene(folder.write("a.glb", glb)).contentHash;
    const uint64_t longer = loadScene(folder.write("b.glb", glb + "a")).contentHash;
    CHECK(longer == (hash ^ 'a') * 0x100000001b3ull);
}

TEST_CASE("Features to come are ignored with one warning each") {
    GltfBuilder builder = oneTriangle();
    builder.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_clearcoat", "EXT_made_up"};
    builder.json["extensionsRequired"] = {"KHR_materials_sheen"};
    builder.json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
    const Scene scene = load(builder);
    CHECK(scene.triangles.size() == 1);
    CHECK(scene.notes.warnings.size() == 5);
    for (const char* words : {"KHR_materials_sheen", "KHR_materials_clearcoat",
                              "optional extensions ignored: EXT_made_up", "animations", "morph targets"})
        CHECK_THAT(joined(scene.notes), ContainsSubstring(words));
}
