// Files that are broken or hostile: each ends with the right exit code and a sentence that names the file and
// the thing.
#include "engine/error.h"
#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <functional>

using namespace irradia;
using namespace irradia::test;
using Catch::Matchers::ContainsSubstring;

namespace {

// The code and the sentence of the error that `load` ends with.
void checkError(const std::function<void()>& load, ExitCode code, const std::string& file,
                const std::string& thing) {
    try {
        load();
        FAIL_CHECK("no error; expected: " << thing);
    } catch (const Error& error) {
        CHECK(error.code() == code);
        CHECK_THAT(error.what(), ContainsSubstring(file));
        CHECK_THAT(error.what(), ContainsSubstring(thing));
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
}

void checkBytes(const std::string& bytes, const std::string& thing, ExitCode code = ExitCode::BadData,
                const std::string& name = "broken.glb") {
    const TempFolder folder;
    const auto file = folder.write(name, bytes);
    checkError([&] { loadScene(file); }, code, name, thing);
}

// A valid scene: mesh, texture, camera, skin. Tests spoil one thing.
GltfBuilder valid() {
    GltfBuilder builder;
    builder.mesh({{"attributes", {{"POSITION", builder.vec3(kTriangle)}}},
                  {"indices", builder.indices({0, 1, 2})},
                  {"material", 0}},
                 {{"name", "thing"}});
    builder.json["materials"] = {{{"name", "plain"}}};
    return builder;
}

void checkSpoiled(const std::function<void(Json&)>& spoil, const std::string& thing) {
    GltfBuilder builder = valid();
    spoil(builder.json);
    checkBytes(builder.glb(), thing);
}

std::string nested(size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

} // namespace

TEST_CASE("The unspoiled scene loads") {
    const TempFolder folder;
    CHECK(loadScene(folder.write("valid.glb", valid().glb())).triangles.size() == 1);
}

TEST_CASE("Files that are none") {
    const TempFolder folder;
    checkError([&] { loadScene(folder / "missing.glb"); }, ExitCode::NotFound, "missing.glb", "no such file");
    checkError([&] { loadScene(folder / "."); }, ExitCode::Io, folder.operator/("").string(),
               "not a regular file");
    checkBytes("", "empty");
    checkBytes("value 1\n", "INVALID_JSON");
    checkBytes(std::string(64, '\0'), "INVALID_JSON");
    checkBytes("[]", "", ExitCode::BadData, "broken.gltf");
    checkBytes(R"({"scene": 0})", "asset", ExitCode::BadData, "broken.gltf");
    checkBytes(R"({"asset": {"version": "1.0"}})", "UNKNOWN_ASSET_MAJOR_VERSION", ExitCode::BadData,
               "old.gltf");
}

TEST_CASE("Binary files cut short anywhere, or with lying lengths") {
    const std::string whole = valid().glb();
    for (size_t size = 1; size < whole.size(); size += 7) {
        CAPTURE(size);
        checkBytes(whole.substr(0, size), size < 4 ? "INVALID_JSON" : "GLB_");
    }
    const auto patched = [&](size_t at, size_t value) {
        return whole.substr(0, at) + GltfBuilder::word(value) + whole.substr(at + 4);
    };
    checkBytes(patched(4, 1), "GLB_INVALID_VERSION");
    checkBytes(patched(8, 0xffffffffu), "GLB_LENGTH_MISMATCH");
    checkBytes(patched(12, 0xfffffffcu), "GLB_CHUNK_TOO_BIG");
    checkBytes(patched(16, 0), "GLB_UNEXPECTED_FIRST_CHUNK");
}

TEST_CASE("JSON that would exhaust the stack or the memory") {
    const std::string head = R"({"asset": {"version": "2.0"}, "extras": )";
    checkBytes(head + nested(100000) + "}", "nested deeper", ExitCode::BadData, "deep.gltf");
    checkBytes(nested(100000), "nested deeper", ExitCode::BadData, "deep.gltf");
    std::string objects = head;
    for (int i = 0; i < 100000; ++i) objects += R"({"a":)";
    checkBytes(objects, "nested deeper", ExitCode::BadData, "deep.gltf");
    std::string wide = head + "[0";
    for (int i = 0; i < 5000000; ++i) wide += ",0";
    checkBytes(wide + "]}", "values", ExitCode::BadData, "wide.gltf");
    checkBytes(head + "1e999}", "INVALID_JSON", ExitCode::BadData, "large.gltf");
}

TEST_CASE("Integers that tinygltf would cut, drop or take for absent") {
    checkSpoiled([](Json& json) { json["nodes"][0]["mesh"] = 4294967296; },
                 "/nodes/0/mesh: VALUE_NOT_IN_RANGE");
    checkSpoiled([](Json& json) { json["nodes"][0]["mesh"] = -1; }, "/nodes/0/mesh: TYPE_MISMATCH");
    checkSpoiled([](Json& json) { json["nodes"][0]["mesh"] = 0.0; }, "/nodes/0/mesh: TYPE_MISMATCH");
    checkSpoiled([](Json& json) { json["nodes"][0]["children"] = {"1"}; },
                 "/nodes/0/children/0: TYPE_MISMATCH");
    checkSpoiled([](Json& json) { json["bufferViews"][1]["byteOffset"] = -4; }, "/bufferViews/1/byteOffset");
    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1; },
                 "/meshes/0/primitives/0/attributes/POSITION");
}

TEST_CASE("Names from a file reach the terminal without its control characters") {
    checkSpoiled(
        [](Json& json) {
            json["nodes"][0]["name"] = "a\n\x1b[2J";
            json["nodes"][0]["children"] = {0};
        },
        "node 0 'a??[2J': NODE_LOOP");
}

TEST_CASE("Ranges of buffers, views and accessors") {
    checkSpoiled([](Json& json) { json["buffers"] = {{{"byteLength", 1000000000000}}}; }, "byteLength");
    checkSpoiled([](Json& json) { json["buffers"] = {{{"byteLength", 0}}}; }, "");
    checkSpoiled([](Json& json) { json["bufferViews"][0]["buffer"] = 7; },
                 "buffer view 0: UNRESOLVED_REFERENCE: buffer 7 of 1");
    checkSpoiled([](Json& json) { json["bufferViews"][0]["byteLength"] = 1000000000000; },
                 "BUFFER_VIEW_TOO_LONG");
    checkSpoiled([](Json& json) { json["bufferViews"][0]["byteOffset"] = 1ull << 52; },
                 "BUFFER_VIEW_TOO_LONG");
    checkSpoiled([](Json& json) { json["accessors"][0]["count"] = 4; }, "accessor 0: ACCESSOR_TOO_LONG");
    checkSpoiled([](Json& json) { json["accessors"][0]["count"] = 1000000000000; }, "ACCESSOR_TOO_LONG");
    checkSpoiled([](Json& json) { json["accessors"][0]["count"] = 1ull << 53; }, "ACCESSOR_TOO_LONG");
    checkSpoiled([](Json& json) { json["accessors"][0]["count"] = 0; },
                 "ACCESSOR_INDEX_OOB: accessor 1 element 0 is 0, there are 0 vertices");
    checkSpoiled([](Json& json) { json["accessors"][0]["byteOffset"] = 4; }, "ACCESSOR_TOO_LONG");
    checkSpoiled([](Json& json) { json["accessors"][0]["bufferView"] = 9; }, "UNRESOLVED_REFERENCE");
    checkSpoiled([](Json& json) { json["accessors"][0]["componentType"] = 5130; },
                 "accessor 0: VALUE_NOT_IN_LIST");
    checkSpoiled([](Json& json) { json["accessors"][0]["type"] = "VEC5"; }, "VEC5");
    checkSpoiled([](Json& json) { json["bufferViews"][0]["byteStride"] = 8; }, "ACCESSOR_SMALL_BYTESTRIDE");
    checkSpoiled(
        [](Json& json) {
            json["accessors"][0].erase("bufferView");
            json["accessors"][0]["count"] = 1000000000000;
        },
        "accessor 0: 1000000000000 elements without a buffer view");
}

TEST_CASE("Sparse accessors out of range") {
    const auto spoilSparse = [](int64_t count, std::vector<uint16_t> indices, const std::string& thing) {
        GltfBuilder builder = valid();
        const int index = builder.view(indices);
        const int value = builder.view(std::vector<glm::vec3>(2));
        builder.json["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", index}, {"componentType", 5123}}},
            {"values", {{"bufferView", value}}}};
        checkBytes(builder.glb(), thing);
    };
    spoilSparse(2, {1, 3}, "accessor 0: ACCESSOR_SPARSE_INDEX_OOB: 3 of 3");
    spoilSparse(2, {1, 1}, "ACCESSOR_SPARSE_INDICES_NON_INCREASING");
    spoilSparse(4, {0, 1}, "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE");
    spoilSparse((1ll << 32) + 2, {0, 1}, "/accessors/0/sparse/count: VALUE_NOT_IN_RANGE");
    spoilSparse(3, {0, 1, 2}, "ACCESSOR_TOO_LONG (sparse values)");
}

TEST_CASE("Primitives with broken indices and attributes") {
    GltfBuilder builder = valid();
    builder.json["meshes"][0]["primitives"][0]["indices"] = builder.indices({0, 1, 3});
    checkBytes(builder.glb(), "mesh 0 primitive 0: ACCESSOR_INDEX_OOB: accessor 2 element 2 is 3");

    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0]["indices"] = 0; },
                 "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT");
    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0]["material"] = 3; }, "material 3 of 1");
    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = 9; }, "mode 9");
    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 8; },
                 "mesh 0 primitive 0 NORMAL: UNRESOLVED_REFERENCE");
    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 0; },
                 "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT");
    checkSpoiled([](Json& json) { json["meshes"][0]["primitives"][0].erase("attributes"); }, "attributes");
    builder = valid();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = builder.vec3({{0, 0, 1}});
    checkBytes(builder.glb(), "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT");
}

TEST_CASE("Node hierarchies that are no forest, transforms that are none") {
    checkSpoiled([](Json& json) { json["nodes"][0]["children"] = {0}; }, "node 0 'thing': NODE_LOOP");
    checkSpoiled(
        [](Json& json) {
            json["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
        },
        "NODE_LOOP");
    checkSpoiled(
        [](Json& json) {
            json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, Json::object()};
        },
        "node 2: NODE_PARENT_OVERRIDE");
    checkSpoiled([](Json& json) { json["nodes"][0]["children"] = {5}; },
                 "node 0 'thing': UNRESOLVED_REFERENCE");
    checkSpoiled([](Json& json) { json["scenes"][0]["nodes"] = {4}; }, "scene 0: UNRESOLVED_REFERENCE");
    checkSpoiled([](Json& json) { json["scenes"][0]["nodes"] = {0, 0}; }, "DUPLICATE_ELEMENTS");
    checkSpoiled([](Json& json) { json["scene"] = 2; }, "UNRESOLVED_REFERENCE: scene 2 of 1");
    checkSpoiled([](Json& json) { json["nodes"][0]["mesh"] = 1; }, "mesh 1 of 1");
    checkSpoiled([](Json& json) { json["nodes"][0]["rotation"] = {0, 0, 0, 0}; }, "ROTATION_NON_UNIT");
    checkSpoiled([](Json& json) { json["nodes"][0]["scale"] = {1, 1}; }, "ARRAY_LENGTH_NOT_IN_LIST: scale");
    checkSpoiled([](Json& json) { json["nodes"][0]["matrix"] = std::vector<int>(16, 1); },
                 "NODE_MATRIX_NON_TRS");
}

TEST_CASE("A hierarchy deeper than the stack loads; instancing bombs do not") {
    GltfBuilder chain = valid();
    for (int i = 1; i <= 100000; ++i) {
        chain.json["nodes"].back()["children"] = {i};
        chain.json["nodes"].push_back(Json::object());
    }
    chain.json["nodes"].back()["mesh"] = 0;
    const TempFolder folder;
    CHECK(loadScene(folder.write("chain.glb", chain.glb())).triangles.size() == 2);

    GltfBuilder bomb = valid(); // 1,000 nodes x 100,000 triangles
    bomb.json["meshes"][0]["primitives"][0]["indices"] = bomb.indices(std::vector<uint16_t>(300000, 0));
    for (int i = 0; i < 1000; ++i) bomb.root({{"mesh", 0}});
    checkBytes(bomb.glb(), "triangles allowed");
}

TEST_CASE("Textures and pictures") {
    const auto textured = [](Json& json) {
        json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
        json["textures"] = {{{"source", 0}}};
        json["images"] = {{{"uri", "picture.png"}, {"name", "bark"}}};
    };
    const auto spoil = [&](const std::function<void(Json&)>& change, const std::string& thing,
                           ExitCode code = ExitCode::BadData, const std::string& file = "broken.glb") {
        GltfBuilder builder = valid();
        textured(builder.json);
        change(builder.json);
        const TempFolder folder;
        folder.write("picture.png", "no picture");
        checkError([&] { loadScene(folder.write("broken.glb", builder.glb())); }, code, file, thing);
    };
    spoil([](Json&) {}, "image 0 'bark'");
    spoil([](Json& json) { json["images"][0]["uri"] = "../picture.png"; }, "is not a plain path");
    spoil([](Json& json) { json["images"][0] = {{"bufferView", 1 << 20}}; }, "image[0]");
    spoil([](Json& json) { json["images"][0] = {{"bufferView", 0}}; }, "image 0");
    spoil([](Json& json) { json["textures"][0]["source"] = 1; },
          "texture 0: UNRESOLVED_REFERENCE: image 1 of 1");
    spoil([](Json& json) { json["textures"][0]["sampler"] = 0; },
          "texture 0: UNRESOLVED_REFERENCE: sampler 0 of 0");
    spoil(
        [](Json& json) {
            json["samplers"] = {{{"wrapS", 5}}};
        },
        "sampler 0: VALUE_NOT_IN_LIST: wrap mode 5");
    spoil([](Json& json) { json["materials"][0]["normalTexture"]["index"] = 4; },
          "material 0 'plain': UNRESOLVED_REFERENCE: texture 4 of 1");
    spoil(
        [](Json& json) {
            json["materials"][0]["extensions"]["KHR_materials_specular"]["specularTexture"]["index"] = 6;
        },
        "material 0 'plain' KHR_materials_specular: UNRESOLVED_REFERENCE: texture 6 of 1");
}

TEST_CASE("URIs do not leave the scene's folder") {
    const TempFolder outside;
    outside.write("secret.bin", std::string(42, 's'));
    const auto checkUri = [&](const std::string& uri, const std::string& thing) {
        for (const bool picture : {false, true}) {
            GltfBuilder builder = valid();
            builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}}};
            if (picture) {
                builder.json["images"] = {{{"uri", uri}}};
                builder.json["textures"] = {{{"source", 0}}};
                builder.json["materials"][0]["emissiveTexture"]["index"] = 0;
            } else {
                builder.json["buffers"][0]["uri"] = uri;
            }
            const TempFolder folder;
            std::filesystem::create_symlink(outside / "secret.bin", folder / "link.bin");
            CAPTURE(uri, picture);
            checkError([&] { loadScene(folder.write("broken.glb", builder.glb())); }, ExitCode::BadData,
                       "broken.glb", thing);
        }
    };
    checkUri("../../etc/passwd", "uri '../../etc/passwd' is not a plain path");
    checkUri("%2e%2e/secret.bin", "uri '../secret.bin' is not a plain path");
    checkUri("sub/../../secret.bin", "is not a plain path");
    checkUri("/etc/passwd", "uri '/etc/passwd' is not a plain path");
    checkUri("file:///etc/passwd", "is not a plain path");
    checkUri("https://example.org/a.bin", "is not a plain path");
    checkUri("tex/../../secret.bin", "is not a plain path");
    checkUri("link.bin", "leads outside");
}

TEST_CASE("Buffers beside the file are read; missing ones are not found") {
    GltfBuilder builder = valid();
    builder.json["buffers"] = {{{"uri", "data%201.bin"}, {"byteLength", builder.buffer.size()}}};
    const TempFolder folder;
    const auto file = folder.write("scene.gltf", builder.json.dump());
    checkError([&] { loadScene(file); }, ExitCode::NotFound, "data 1.bin", "no such file");
    folder.write("data 1.bin", builder.buffer);
    CHECK(loadScene(file).triangles.size() == 1);
    folder.write("data 1.bin", builder.buffer.substr(1));
    checkError([&] { loadScene(file); }, ExitCode::BadData, "scene.gltf", "mismatch");
}

TEST_CASE("Extensions that a file cannot be read without") {
    checkSpoiled([](Json& json) { json["extensionsRequired"] = {"KHR_texture_basisu"}; },
                 "the file requires the extension 'KHR_texture_basisu'");
    checkSpoiled(
        [](Json& json) {
            json["extensionsRequired"] = {"KHR_materials_ior", "EXT_made_up"};
            json["accessors"][1].erase(
                "bufferView"); // compressed elsewhere: makes no sense without the extension
        },
        "EXT_made_up");
}

TEST_CASE("Camera files and environments") {
    const TempFolder folder;
    const auto check = [&](const std::string& text, const std::string& thing) {
        checkError([&] { loadCameraFile(folder.write("view.json", text)); }, ExitCode::BadData, "view.json",
                   thing);
    };
    checkError([&] { loadCameraFile(folder / "gone.json"); }, ExitCode::NotFound, "gone.json",
               "no such file");
    check("", "empty");
    check("{", "INVALID_JSON");
    check(nested(100000), "nested deeper");
    check("{}", "camera");
    check(R"({"camera": {"position": [0, 0, 0]}})", "camera.look_at");
    check(R"({"camera": {"position": [0, 0], "look_at": [0, 0, 1], "vfov_deg": 40}})", "camera.position");
    check(R"({"camera": {"position": [0, 0, 0], "look_at": [0, 0, 0], "vfov_deg": 40}})", "camera.look_at");
    check(R"({"camera": {"position": [0, 0, 0], "look_at": [0, 9, 0], "vfov_deg": 40}})", "camera.up");
    check(R"({"camera": {"position": [0, 0, 0], "look_at": [0, 0, 1], "vfov_deg": 180}})", "camera.vfov_deg");
    check(R"({"camera": {"position": [0, 0, 0], "look_at": [0, 0, 1], "vfov_deg": 40, "fov": 50}})",
          "unknown key \"fov\", there are position, look_at, up, vfov_deg, aspect in 'camera'");
    check(R"({"camera": {"position": [0, 0, 0], "look_at": [0, 0, 1], "vfov_deg": 40}, "env": [1, 2]})",
          "env");

    checkError([] { loadEnvironment("1,2,-3"); }, ExitCode::BadData, "1,2,-3", "not negative");
    checkError([] { loadEnvironment("1,2"); }, ExitCode::BadData, "1,2", "neither R,G,B");
    checkError([&] { loadEnvironment((folder / "gone.hdr").string()); }, ExitCode::NotFound, "gone.hdr",
               "no such");
    checkError([&] { loadEnvironment(folder.write("bad.exr", "no EXR").string()); }, ExitCode::BadData,
               "bad.exr", "");
}

TEST_CASE("No byte of a file, changed at random, does worse than an error") {
    const std::string whole = valid().glb();
    const TempFolder folder;
    uint32_t state = 12345;
    const auto random = [&](uint32_t below) {
        state = state * 1664525u + 1013904223u;
        return static_cast<uint32_t>((uint64_t{state} * below) >> 32);
    };
    for (int round = 0; round < 2000; ++round) {
        std::string changed = whole;
        for (uint32_t n = 1 + random(3); n > 0; --n)
            changed[random(static_cast<uint32_t>(changed.size()))] = static_cast<char>(random(256));
        try {
            const Scene scene = loadScene(folder.write("fuzz.glb", changed));
            for (const Triangle& triangle : scene.triangles)
                for (int c = 0; c < 3; ++c) REQUIRE(triangle.vertex[c] < scene.vertices.size());
        } catch (const Error& error) {
            REQUIRE((error.code() == ExitCode::BadData || error.code() == ExitCode::NotFound));
        }
    }
}
