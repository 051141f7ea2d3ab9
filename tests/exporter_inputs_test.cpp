// glTF as exporters write it, a little beside the specification or in its corners: each file is rendered to
// the radiance it means, and says what was left out.
#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"
#include "tests/support/expect_error.h"
#include "tests/support/gpu_render.h"
#include "tests/support/picture_bytes.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>
#include <numeric>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr int kSize = 16;

// A black square of radiance 1, x and y from -1 to 1, that fills the view of a camera at (0, 0, 1).
GltfBuilder lamp() {
    GltfBuilder builder;
    const int positions = builder.vec3({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    const int uv = builder.vec2({{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    builder.mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}}},
                  {"indices", builder.indices({0, 1, 2, 0, 2, 3})},
                  {"material", 0}});
    builder.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}, {"emissiveFactor", {1, 1, 1}}}};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.5}, {"znear", 0.1}}}}};
    builder.root({{"camera", 0}, {"translation", {0, 0, 1}}});
    return builder;
}

// The lamp with a picture as its emission.
GltfBuilder pictureLamp(const Json& image) {
    GltfBuilder builder = lamp();
    builder.json["images"] = {image};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"][0]["emissiveTexture"]["index"] = 0;
    return builder;
}

std::string base64(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string text(const std::vector<uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

std::string joined(const Scene& scene) {
    std::string all;
    for (const std::string& warning : scene.notes.warnings) all += warning + "\n";
    return all;
}

// What the camera sees of the light itself, without bounces: no noise.
std::vector<glm::vec3> render(const Scene& scene) {
    PathTracerOptions options;
    options.width = options.height = kSize;
    options.maxBounces = 0;
    GpuRenderer renderer(deviceWith(QuadAccess::Texel), scene);
    return renderer.render(chooseCamera(scene, "").camera, options, 2).mean;
}

void checkRadiance(const Scene& scene, const glm::vec3& expected, float tolerance = 0.0f) {
    for (const glm::vec3& pixel : render(scene))
        for (int c = 0; c < 3; ++c) REQUIRE(std::abs(pixel[c] - expected[c]) <= tolerance);
}

Scene load(const GltfBuilder& builder) {
    const TempFolder folder;
    return loadScene(folder.write("scene.glb", builder.glb()));
}

// sRGB 200, 100, 50 in linear light; the tolerance is what half floats round.
constexpr glm::vec3 kBark{0.5776f, 0.1274f, 0.0319f};
constexpr float kHalf = 5e-4f;

std::string barkPng() {
    return text(makePng({.width = 1, .height = 1}, {200, 100, 50}));
}

} // namespace

TEST_CASE("a matrix that an exporter rounded") {
    GltfBuilder builder = lamp();
    builder.json["nodes"][0]["matrix"] = {1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, -1e-5, 0, 0, 0, 1.0000001};
    checkRadiance(load(builder), glm::vec3(1));
    builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5};
    expectError(ExitCode::BadData, "NODE_MATRIX_NON_TRS", [&] { load(builder); });
}

TEST_CASE("an accessor of no elements is left out, and so is what uses it") {
    GltfBuilder builder = lamp();
    Json empty = builder.json["accessors"][0];
    empty["count"] = 0;
    empty["min"] = empty["max"] = {nullptr, nullptr, nullptr};
    builder.json["accessors"].push_back(empty);
    const int last = int(builder.json["accessors"].size()) - 1;
    SECTION("unused") {}
    SECTION("of a primitive without vertices") {
        builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", last}}}});
    }
    const Scene scene = load(builder);
    CHECK(scene.triangles.size() == 2);
    CHECK(joined(scene) ==
          "accessor " + std::to_string(last) + ": VALUE_NOT_IN_RANGE: count 0: what uses it is left out\n");
    checkRadiance(scene, glm::vec3(1));
}

TEST_CASE("a folder that a path enters and leaves again") {
    GltfBuilder builder = lamp();
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}, {"uri", "tex/../a.bin"}}};
    const TempFolder folder;
    folder.write("a.bin", builder.buffer);
    checkRadiance(loadScene(folder.write("scene.gltf", builder.json.dump())), glm::vec3(1));
}

TEST_CASE("a buffer's file may be longer than the buffer, and have a plus sign in its name") {
    GltfBuilder builder = lamp();
    const TempFolder folder;
    folder.write("a+b c.bin", builder.buffer + std::string(3, '\0'));
    for (const char* uri : {"a+b%20c.bin", "a%2Bb c.bin"}) {
        builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}, {"uri", uri}}};
        CHECK(loadScene(folder.write("scene.gltf", builder.json.dump())).triangles.size() == 2);
    }
}

TEST_CASE("backslashes between folders") {
    GltfBuilder builder = lamp();
    const TempFolder folder;
    std::filesystem::create_directory(folder / "data");
    folder.write("data/a.bin", builder.buffer);
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}, {"uri", "data\\a.bin"}}};
    CHECK(loadScene(folder.write("scene.gltf", builder.json.dump())).triangles.size() == 2);
    builder.json["buffers"][0]["uri"] = "..\\a.bin";
    expectError(ExitCode::BadData, "is not a plain path",
                [&] { loadScene(folder.write("scene.gltf", builder.json.dump())); });
}

TEST_CASE("buffers in data URIs of any media type, parameters and case") {
    GltfBuilder builder = lamp();
    std::vector<uint8_t> all(256); // base64 writes them with both of its signs: "+" is a space to some
    std::iota(all.begin(), all.end(), uint8_t{0});
    builder.view(all);
    const std::string data = base64(builder.buffer);
    REQUIRE(data.find('+') != std::string::npos);
    const TempFolder folder;
    for (const char* head :
         {"data:application/octet-stream;base64,", "data:application/binary;base64,", "data:;base64,",
          "DATA:application/gltf-buffer;BASE64,", "data:application/octet-stream;charset=utf-8;base64,"}) {
        CAPTURE(head);
        builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}, {"uri", head + data}}};
        const Scene scene = loadScene(folder.write("scene.gltf", builder.json.dump()));
        CHECK(scene.triangles.size() == 2);
        CHECK(scene.vertices[0].position == glm::vec3(-1, -1, 0));
    }
}

TEST_CASE("pictures in data URIs of any media type") {
    const std::string data = base64(barkPng());
    for (const char* head :
         {"data:image/png;base64,", "data:image/jpg;base64,", "data:image/PNG;base64,", "Data:;Base64,"}) {
        CAPTURE(head);
        checkRadiance(load(pictureLamp({{"uri", head + data}})), kBark, kHalf);
    }
}

TEST_CASE("messages hold no base64") {
    const std::string data = base64(std::string(600, 'x'));
    for (const char* head :
         {"data:image/webp;base64,", "data:image/png;base64,", "data:image/webp,", "data:broken;base64,!!"}) {
        CAPTURE(head);
        for (const bool picture : {true, false}) {
            GltfBuilder builder = picture ? pictureLamp({{"uri", head + data}}) : lamp();
            if (!picture) builder.json["buffers"] = {{{"byteLength", 7}, {"uri", head + data}}};
            try {
                load(builder);
                FAIL_CHECK("no error");
            } catch (const Error& error) {
                CHECK(error.code() == ExitCode::BadData);
                CHECK(std::string(error.what()).size() < 200);
                CHECK(std::string(error.what()).find("eHh4") == std::string::npos); // "xxx"
            }
        }
    }
}

TEST_CASE("a missing picture is left out with a warning, whatever it was for") {
    for (const char* use : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
        CAPTURE(use);
        GltfBuilder builder = lamp();
        builder.json["images"] = {{{"uri", "gone.png"}}};
        builder.json["textures"] = {{{"source", 0}}};
        builder.json["materials"][0][use]["index"] = 0;
        const Scene scene = load(builder);
        checkRadiance(scene, glm::vec3(1));
        const bool isRead = use != std::string("occlusionTexture"); // light is traced, not painted
        CHECK(joined(scene) == (isRead ? "texture 0 is left out: image 0 'gone.png' is missing\n" : ""));
    }
}

TEST_CASE("JPEGs of inks are the colours they print") {
    // 255 x (1 - ink): red = cyan's x black's / 255.
    const std::vector<uint8_t> unprinted{222, 111, 56, 230}, printed{33, 144, 199, 25};
    const auto check = [](JpegForm form, const std::vector<uint8_t>& inks) {
        std::vector<uint8_t> samples;
        for (int i = 0; i < 64; ++i) samples.insert(samples.end(), inks.begin(), inks.end());
        GltfBuilder builder = pictureLamp({{"mimeType", "image/jpeg"}});
        builder.json["images"][0]["bufferView"] = builder.view(makeJpeg(form, 8, 8, samples));
        checkRadiance(load(builder), kBark, 0.006f); // one step of the eight bits
    };
    check(JpegForm::Cmyk, unprinted);
    check(JpegForm::Ycck, unprinted);
    check(JpegForm::CmykPlain, printed);
}

TEST_CASE("an orthographic camera sees by parallel rays") {
    GltfBuilder builder = lamp();
    builder.json["cameras"][0] = {
        {"type", "orthographic"},
        {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.01}, {"zfar", 10}}}};
    checkRadiance(load(builder), glm::vec3(1));

    // Seen 4 high the square fills the middle half, however far it is.
    builder.json["cameras"][0]["orthographic"]["ymag"] = 2;
    for (const int distance : {1, 50}) {
        builder.json["nodes"][1]["translation"] = {0, 0, distance};
        const auto pixels = render(load(builder));
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const bool inside = x >= 4 && x < 12 && y >= 4 && y < 12;
                REQUIRE(pixels[size_t(y * kSize + x)] == glm::vec3(inside ? 1.0f : 0.0f));
            }
    }
    builder.json["cameras"][0]["orthographic"]["ymag"] = 0;
    expectError(ExitCode::BadData, "camera 0: VALUE_NOT_IN_RANGE: ymag", [&] { load(builder); });
}

TEST_CASE("cameras that cannot be used are named, and the view instead") {
    GltfBuilder builder = lamp();
    builder.json["nodes"][1]["scale"] = {0, 0, 0};
    CHECK(joined(load(builder)) == "camera 0 is left out: its node has no orientation\n"
                                   "no camera of the file can be used: the view frames the whole scene\n");
}

TEST_CASE("extensions that are undeclared, or required and not rendered") {
    GltfBuilder builder = lamp();
    builder.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 3;
    builder.json["materials"][0]["extras"]["extensions"]["EXT_none"] = 1;
    CHECK(joined(load(builder)) ==
          "extensions used but not declared in extensionsUsed: KHR_materials_emissive_strength\n");
    checkRadiance(load(builder), glm::vec3(3));

    builder = lamp();
    builder.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_sheen", "EXT_look"};
    builder.json["extensionsRequired"] = {"KHR_materials_clearcoat"};
    CHECK(
        joined(load(builder)) ==
        "the file requires KHR_materials_clearcoat, which is not rendered yet: such materials have no coat\n"
        "KHR_materials_sheen is not supported yet: such materials have no sheen\n"
        "optional extensions ignored: EXT_look\n");
    for (const char* unreadable : {"KHR_texture_basisu", "EXT_look"}) {
        builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {unreadable};
        expectError(ExitCode::BadData, std::string("requires the extension '") + unreadable + "'",
                    [&] { load(builder); });
    }
}

TEST_CASE("a file that is no glTF is named for what it is") {
    using namespace std::string_literals;
    const std::pair<std::string, const char*> files[] = {
        {"# Blender\n\nmtllib a.mtl\nv 0 0 0\n", "a Wavefront OBJ or MTL file"},
        {"v 1.0 2.0 3.0\r\nv 1 1 1\r\n", "a Wavefront OBJ or MTL file"},
        {"Kaydara FBX Binary  \0\x1a"s, "an FBX file"},
        {"; FBX 7.3.0 project file\n", "an FBX file"},
        {"#usda 1.0\n", "a USD file"},
        {"PXR-USDC\0\0"s, "a USD file"},
        {"PK\3\4rest", "a zip archive (or USDZ, 3MF)"},
        {"\x1f\x8b\x08", "a gzip archive"},
        {"\xff\xfe{\0\"\0"s, "UTF-16 text; glTF is UTF-8"},
        {"{\0\"\0"s, "UTF-16 text; glTF is UTF-8"},
        {"BLENDER-v300", "a Blender file"},
        {"ply\nformat ascii 1.0\n", "a PLY file"},
        {"solid cube\n", "an STL file"},
        {"<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA file"},
        {"\n<!DOCTYPE html><html>", "an HTML page"},
        {"\x89PNG\r\n\x1a\n", "a PNG picture"},
        {"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS to a file that is not here"},
    };
    const TempFolder folder;
    for (const auto& [bytes, name] : files)
        expectError(ExitCode::BadData,
                    std::string("scene.gltf: this is ") + name + ": a glTF 2.0 scene is needed",
                    [&] { loadScene(folder.write("scene.gltf", bytes)); });
    expectError(ExitCode::BadData, "INVALID_JSON", [&] { loadScene(folder.write("scene.gltf", "value 1")); });
}

TEST_CASE("no validation messages") {
    CHECK(deviceWith(QuadAccess::Texel).validationMessages() == 0);
}
