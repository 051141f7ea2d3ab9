// Compressed geometry and pictures: KHR_draco_mesh_compression, EXT_meshopt_compression, EXT_texture_webp,
// made here by the libraries that read them; whole, cut short, and with counts that lie.
#include "engine/scene/load_scene.h"
#include "engine/scene/validate_scene.h"
#include "tests/gltf_builder.h"
#include "tests/support/expect_error.h"
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <draco/compression/encode.h>
#include <functional>
#include <meshoptimizer.h>
#include <random>
#include <webp/encode.h>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kMeshopt = "EXT_meshopt_compression";
using Bytes = std::vector<uint8_t>;

// A grid of 9 x 9 points, 128 triangles.
constexpr int kSide = 9;

std::vector<glm::vec3> gridPoints() {
    std::vector<glm::vec3> points;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) points.push_back(glm::vec3(x, y, 0.5f * float(x * y % 3)) * 0.25f);
    return points;
}

std::vector<uint32_t> gridIndices() {
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y + 1 < kSide; ++y)
        for (uint32_t x = 0; x + 1 < kSide; ++x) {
            const uint32_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
            indices.insert(indices.end(), {a, b, d, a, d, c});
        }
    return indices;
}

constexpr size_t kPoints = kSide * kSide, kCorners = 6 * (kSide - 1) * (kSide - 1);

Scene load(const GltfBuilder& builder) {
    const TempFolder folder;
    return loadScene(folder.write("scene.glb", builder.glb()));
}

// The corners of all triangles, each from its least, in one order whatever they were stored in.
std::vector<std::array<float, 9>> sortedTriangles(const Scene& scene) {
    std::vector<std::array<float, 9>> triangles;
    for (const Triangle& triangle : scene.triangles) {
        std::array<glm::vec3, 3> p;
        for (int c = 0; c < 3; ++c) p[c] = scene.vertices[triangle.vertex[c]].position;
        const auto less = [](const glm::vec3& a, const glm::vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        std::ranges::rotate(p, std::ranges::min_element(p, less));
        triangles.push_back({p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z});
    }
    std::ranges::sort(triangles);
    return triangles;
}

// The grid as it is.
Scene plainGrid() {
    GltfBuilder builder;
    const int indices = builder.accessor(builder.view(gridIndices()), 5125, kCorners, "SCALAR");
    builder.mesh({{"attributes", {{"POSITION", builder.vec3(gridPoints())}}}, {"indices", indices}});
    return load(builder);
}

int emptyAccessor(GltfBuilder& builder, int componentType, size_t count, const std::string& type) {
    builder.json["accessors"].push_back({{"componentType", componentType}, {"count", count}, {"type", type}});
    return static_cast<int>(builder.json["accessors"].size()) - 1;
}

// A file with some of its bytes changed at random does no worse than an error.
void checkDamage(const std::string& glb, int rounds) {
    const TempFolder folder;
    std::mt19937 random(7);
    const size_t begin = glb.find("BIN") + 5;
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
        std::string changed = glb;
        for (auto k = random() % 4 + 1; k > 0; --k)
            changed[begin + random() % (glb.size() - begin)] = static_cast<char>(random());
        try {
            const Scene scene = loadScene(folder.write("fuzz.glb", changed));
            for (const Triangle& triangle : scene.triangles)
                for (int c = 0; c < 3; ++c) REQUIRE(triangle.vertex[c] < scene.vertices.size());
        } catch (const Error& error) {
            REQUIRE((error.code() == ExitCode::BadData || error.code() == ExitCode::OutOfMemory));
            ++refused;
        }
    }
    CHECK(refused > 0);
}

// ---- Draco

Bytes dracoGrid(int method, bool withNormals = false) {
    draco::Mesh mesh;
    const auto points = gridPoints();
    const auto indices = gridIndices();
    mesh.set_num_points(kPoints);
    const auto add = [&](draco::GeometryAttribute::Type type, const auto& valueOf) {
        draco::GeometryAttribute attribute;
        attribute.Init(type, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
        const int id = mesh.AddAttribute(attribute, true, kPoints);
        for (uint32_t i = 0; i < kPoints; ++i) {
            const glm::vec3 value = valueOf(i);
            mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &value);
        }
    };
    add(draco::GeometryAttribute::POSITION, [&](size_t i) { return points[i]; });
    if (withNormals) add(draco::GeometryAttribute::NORMAL, [](size_t) { return glm::vec3(0, 0, 1); });
    for (size_t i = 0; i < indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(indices[i]), draco::PointIndex(indices[i + 1]),
                      draco::PointIndex(indices[i + 2])});
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

GltfBuilder dracoScene(const Bytes& data, bool withNormals = false) {
    GltfBuilder builder;
    const int view = builder.view(data);
    Json attributes{{"POSITION", emptyAccessor(builder, 5126, kPoints, "VEC3")}}, ids{{"POSITION", 0}};
    if (withNormals) {
        attributes["NORMAL"] = emptyAccessor(builder, 5126, kPoints, "VEC3");
        ids["NORMAL"] = 1;
    }
    builder.mesh({{"attributes", attributes},
                  {"indices", emptyAccessor(builder, 5123, kCorners, "SCALAR")},
                  {"extensions", {{kDraco, {{"bufferView", view}, {"attributes", ids}}}}}});
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {kDraco};
    return builder;
}

Json& primitiveOf(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0];
}

Json& dracoOf(GltfBuilder& builder) {
    return primitiveOf(builder)["extensions"][kDraco];
}

} // namespace

TEST_CASE("Draco, sequential and by Edgebreaker, is the mesh it was made from") {
    const auto plain = sortedTriangles(plainGrid());
    REQUIRE(plain.size() == kCorners / 3);
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
        for (const bool withNormals : {false, true}) {
            CAPTURE(method, withNormals);
            const Scene scene = load(dracoScene(dracoGrid(method, withNormals), withNormals));
            CHECK(scene.notes.warnings.empty());
            CHECK(sortedTriangles(scene) == plain);
            if (withNormals) CHECK(scene.vertices.size() == kPoints);
            if (withNormals) CHECK(scene.vertices[40].normal == glm::vec3(0, 0, 1));
        }
}

TEST_CASE("Draco without indices of the primitive, as strips, twice, and beside the file") {
    const Bytes data = dracoGrid(draco::MESH_SEQUENTIAL_ENCODING);
    GltfBuilder builder = dracoScene(data);
    primitiveOf(builder)["mode"] = 5;
    CHECK(load(builder).triangles.size() == kCorners / 3);
    builder = dracoScene(data);
    primitiveOf(builder).erase("indices");
    CHECK(load(builder).triangles.size() == kCorners / 3);
    builder = dracoScene(data);
    builder.mesh(primitiveOf(builder)); // the same accessors
    CHECK(load(builder).triangles.size() == 2 * kCorners / 3);

    builder = dracoScene(data);
    const TempFolder folder;
    folder.write("a.bin", builder.buffer);
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}, {"uri", "a.bin"}}};
    CHECK(loadScene(folder.write("scene.gltf", builder.json.dump())).triangles.size() == kCorners / 3);
}

TEST_CASE("Draco data cut short anywhere") {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const Bytes whole = dracoGrid(method);
        for (size_t size = 0; size < whole.size(); size += whole.size() / 40) {
            CAPTURE(method, size);
            Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            if (cut.empty()) cut.push_back(0);
            expectError(ExitCode::BadData, "mesh 0 primitive 0: DRACO_INVALID_STREAM: the",
                        [&] { load(dracoScene(cut)); });
        }
    }
}

TEST_CASE("Draco with counts that lie, and what is not there") {
    const Bytes whole = dracoGrid(draco::MESH_SEQUENTIAL_ENCODING);
    const auto check = [&](const std::string& sentence, const std::function<void(GltfBuilder&)>& spoil) {
        GltfBuilder builder = dracoScene(whole);
        spoil(builder);
        expectError(ExitCode::BadData, sentence, [&] { load(builder); });
    };
    check("mesh 0 primitive 0 POSITION: DRACO_ACCESSOR_MISMATCH: 81 elements, accessor 0 has 80",
          [](GltfBuilder& b) { b.json["accessors"][0]["count"] = 80; });
    check("81 elements, accessor 0 has 9007199254740992",
          [](GltfBuilder& b) { b.json["accessors"][0]["count"] = 1ull << 53; });
    check("mesh 0 primitive 0 indices: DRACO_ACCESSOR_MISMATCH: 384 elements, accessor 1 has 3",
          [](GltfBuilder& b) { b.json["accessors"][1]["count"] = 3; });
    check("POSITION: DRACO_ACCESSOR_MISMATCH: 3 components, those of accessor 0 are others",
          [](GltfBuilder& b) { b.json["accessors"][0]["type"] = "VEC4"; });
    check("UNRESOLVED_REFERENCE: the data have no attribute 5",
          [](GltfBuilder& b) { dracoOf(b)["attributes"]["POSITION"] = 5; });
    check("NORMAL: UNRESOLVED_REFERENCE: the primitive has no such attribute",
          [](GltfBuilder& b) { dracoOf(b)["attributes"]["NORMAL"] = 0; });
    check("UNRESOLVED_REFERENCE: buffer view 9 of 1", [](GltfBuilder& b) { dracoOf(b)["bufferView"] = 9; });
    check("bufferView: TYPE_MISMATCH", [](GltfBuilder& b) { dracoOf(b)["bufferView"] = -1; });
    check("UNDEFINED_PROPERTY", [](GltfBuilder& b) { dracoOf(b).erase("attributes"); });
    check("VALUE_NOT_IN_LIST: mode 1", [](GltfBuilder& b) { primitiveOf(b)["mode"] = 1; });
    check("BUFFER_VIEW_TOO_LONG", [](GltfBuilder& b) { b.json["bufferViews"][0]["byteLength"] = 1 << 20; });
    check("UNRESOLVED_REFERENCE: accessor 99", [](GltfBuilder& b) { primitiveOf(b)["indices"] = 99; });

    Bytes lie(whole.begin(), whole.begin() + 11); // the header, then faces as a number of 7 bits a byte
    lie.insert(lie.end(), {0x8f, 0xff, 0xff, 0xff, 0x7f, 3, 0, 0, 0, 0, 0, 0});
    expectError(ExitCode::BadData, "compressed bytes cannot hold", [&] { load(dracoScene(lie)); });
    Bytes old = whole;
    old[6] = 1;
    expectError(ExitCode::BadData, "Draco's bitstream 2.1, only 2.2 can be read",
                [&] { load(dracoScene(old)); });
}

TEST_CASE("Draco data damaged at random") {
    checkDamage(dracoScene(dracoGrid(draco::MESH_SEQUENTIAL_ENCODING)).glb(), 300);
    checkDamage(dracoScene(dracoGrid(draco::MESH_EDGEBREAKER_ENCODING, true), true).glb(), 300);
}

// ---- meshopt

namespace {

template <typename T>
Bytes meshoptVertices(const std::vector<T>& values) {
    Bytes bytes(meshopt_encodeVertexBufferBound(values.size(), sizeof(T)));
    bytes.resize(
        meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), values.size(), sizeof(T)));
    return bytes;
}

Bytes meshoptTriangles(const std::vector<uint32_t>& indices) {
    meshopt_encodeIndexVersion(1);
    Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), kPoints));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

Bytes meshoptSequence(const std::vector<uint32_t>& indices) {
    Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), kPoints));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

struct Compressed {
    Bytes bytes;
    size_t count = 0, stride = 0;
    std::string mode = "ATTRIBUTES", filter = "NONE";
};

// A view of the fallback buffer, which has no data, with the data it stands for.
int meshoptView(GltfBuilder& builder, const Compressed& data) {
    const int stored = builder.view(data.bytes);
    Json view = builder.json["bufferViews"][stored];
    Json extension{{"buffer", 0},
                   {"byteOffset", view["byteOffset"]},
                   {"byteLength", view["byteLength"]},
                   {"byteStride", data.stride},
                   {"count", data.count},
                   {"mode", data.mode}};
    if (data.filter != "NONE") extension["filter"] = data.filter;
    view = {{"buffer", 1}, {"byteLength", data.count * data.stride}, {"extensions", {{kMeshopt, extension}}}};
    if (data.mode == "ATTRIBUTES") view["byteStride"] = data.stride;
    builder.json["bufferViews"][stored] = view;
    return stored;
}

void finishMeshopt(GltfBuilder& builder, bool isMarked = true) {
    Json fallback{{"byteLength", 1 << 20}};
    if (isMarked) fallback["extensions"][kMeshopt]["fallback"] = true;
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}}, fallback};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {kMeshopt, "KHR_mesh_quantization"};
}

GltfBuilder meshoptScene(const Compressed& indices, bool isMarked = true) {
    GltfBuilder builder;
    const int positions = meshoptView(builder, {meshoptVertices(gridPoints()), kPoints, 12});
    const int triangles = meshoptView(builder, indices);
    builder.mesh(
        {{"attributes", {{"POSITION", builder.accessor(positions, 5126, kPoints, "VEC3")}}},
         {"indices", builder.accessor(triangles, indices.stride == 2 ? 5123 : 5125, kCorners, "SCALAR")}});
    finishMeshopt(builder, isMarked);
    return builder;
}

GltfBuilder meshoptScene() {
    return meshoptScene({meshoptTriangles(gridIndices()), kCorners, 4, "TRIANGLES"});
}

Json& meshoptOf(GltfBuilder& builder, int view = 0) {
    return builder.json["bufferViews"][view]["extensions"][kMeshopt];
}

// The normal or the like that vertex 0 of a triangle has in a filtered view.
GltfBuilder filtered(const std::string& attribute, const Compressed& data, int componentType,
                     const std::string& type) {
    GltfBuilder builder;
    const int view = meshoptView(builder, data);
    const int accessor = builder.accessor(view, componentType, 3, type);
    builder.json["accessors"][accessor]["normalized"] = componentType != 5126;
    const int positions = builder.vec3(kTriangle);
    builder.mesh({{"attributes", {{"POSITION", positions}, {attribute, accessor}}}});
    finishMeshopt(builder);
    return builder;
}

} // namespace

TEST_CASE("meshopt: attributes, triangles and sequences of indices, behind fallback buffers without data") {
    const auto plain = sortedTriangles(plainGrid());
    for (const size_t stride : {2, 4})
        for (const bool isMarked : {true, false}) {
            CAPTURE(stride, isMarked);
            CHECK(sortedTriangles(load(meshoptScene(
                      {meshoptTriangles(gridIndices()), kCorners, stride, "TRIANGLES"}, isMarked))) == plain);
            CHECK(sortedTriangles(load(meshoptScene(
                      {meshoptSequence(gridIndices()), kCorners, stride, "INDICES"}, isMarked))) == plain);
        }
    CHECK(load(meshoptScene()).notes.warnings.empty());

    GltfBuilder builder = meshoptScene();
    const TempFolder folder;
    folder.write("a.bin", builder.buffer);
    builder.json["buffers"][0]["uri"] = "a.bin";
    const auto file = folder.write("scene.gltf", builder.json.dump());
    CHECK(sortedTriangles(loadScene(file)) == plain);
    for (const Finding& finding : validateScene(file)) CHECK(finding.severity != Severity::Error);
}

TEST_CASE("meshopt filters: octahedral normals, quaternions, exponents") {
    const std::vector<float> normals{0.6f, 0, 0.8f, 0, 0, -1, 0, 0, 1, 0, 0, 0}; // of four numbers
    for (const size_t stride : {4, 8}) {
        Bytes stored(3 * stride);
        meshopt_encodeFilterOct(stored.data(), 3, stride, stride == 4 ? 8 : 12, normals.data());
        Compressed data{{}, 3, stride, "ATTRIBUTES", "OCTAHEDRAL"};
        data.bytes.resize(meshopt_encodeVertexBufferBound(3, stride));
        data.bytes.resize(
            meshopt_encodeVertexBuffer(data.bytes.data(), data.bytes.size(), stored.data(), 3, stride));
        const Scene scene = load(filtered("NORMAL", data, stride == 4 ? 5120 : 5122, "VEC3"));
        CHECK(glm::length(scene.vertices[0].normal - glm::vec3(0.6f, 0, 0.8f)) < 0.02f);
    }

    // 2^exponent x mantissa, of 8 and 24 bits: 1 = 2^-4 x 16.
    const uint32_t one = 0xfcu << 24 | 16u;
    const std::vector<std::array<uint32_t, 3>> triples{{0, 0, 0}, {one, 0, 0}, {0, one, 0}};
    GltfBuilder builder =
        filtered("_OWN", {meshoptVertices(triples), 3, 12, "ATTRIBUTES", "EXPONENTIAL"}, 5126, "VEC3");
    builder.json["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", 0}};
    const Scene scene = load(builder);
    REQUIRE(scene.triangles.size() == 1);
    for (size_t i = 0; i < 3; ++i) CHECK(scene.vertices[i].position == kTriangle[i]);

    const float h = std::sqrt(0.5f);
    const std::vector<float> turns{0, 0, h, h};
    std::vector<std::array<int16_t, 4>> quaternions(1);
    meshopt_encodeFilterQuat(quaternions.data(), 1, 8, 12, turns.data());
    GltfBuilder instanced;
    const int view = meshoptView(instanced, {meshoptVertices(quaternions), 1, 8, "ATTRIBUTES", "QUATERNION"});
    const int rotation = instanced.accessor(view, 5122, 1, "VEC4");
    instanced.json["accessors"][rotation]["normalized"] = true;
    instanced.mesh(
        {{"attributes", {{"POSITION", instanced.vec3(kTriangle)}}}},
        {{"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", rotation}}}}}}}});
    finishMeshopt(instanced);
    instanced.json["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
    const Scene turned = load(instanced);
    CHECK(glm::length(turned.vertices[1].position - glm::vec3(0, 1, 0)) < 2e-3f);
}

TEST_CASE("meshopt data cut short, damaged, and with counts that lie") {
    for (const int view : {0, 1})
        for (const int less : {1, 2, 20, 50}) {
            CAPTURE(view, less);
            GltfBuilder builder = meshoptScene();
            Json& length = meshoptOf(builder, view)["byteLength"];
            length = std::max(length.get<int>() - less, 1);
            expectError(ExitCode::BadData, fmt::format("buffer view {}: MESHOPT_INVALID_STREAM: the ", view),
                        [&] { load(builder); });
        }
    const auto check = [](const std::string& sentence,
                          const std::function<void(GltfBuilder&, Json&)>& spoil) {
        GltfBuilder builder = meshoptScene();
        spoil(builder, meshoptOf(builder));
        expectError(ExitCode::BadData, sentence, [&] { load(builder); });
    };
    check("buffer view 0: VALUE_NOT_IN_RANGE: 972 bytes, compressed are 960",
          [](GltfBuilder&, Json& meshopt) { meshopt["count"] = 80; });
    check("compressed bytes cannot hold", [](GltfBuilder& builder, Json& meshopt) {
        meshopt["count"] = 1 << 30;
        builder.json["bufferViews"][0]["byteLength"] = 12ull << 30;
    });
    check("count: VALUE_NOT_IN_RANGE", [](GltfBuilder&, Json& meshopt) { meshopt["count"] = 1ull << 40; });
    check("count: TYPE_MISMATCH", [](GltfBuilder&, Json& meshopt) { meshopt["count"] = -3; });
    check("VALUE_NOT_IN_RANGE", [](GltfBuilder&, Json& meshopt) { meshopt["count"] = 0; });
    check("VALUE_NOT_IN_LIST: byteStride 6", [](GltfBuilder& builder, Json& meshopt) {
        meshopt["byteStride"] = 6;
        builder.json["bufferViews"][0]["byteLength"] = 6 * kPoints;
    });
    check("VALUE_NOT_IN_LIST: mode 'STRIPS'",
          [](GltfBuilder&, Json& meshopt) { meshopt["mode"] = "STRIPS"; });
    check("VALUE_NOT_IN_LIST: filter 'BLUR'",
          [](GltfBuilder&, Json& meshopt) { meshopt["filter"] = "BLUR"; });
    check("VALUE_NOT_IN_LIST: filter OCTAHEDRAL of ATTRIBUTES, 12 bytes apart",
          [](GltfBuilder&, Json& meshopt) { meshopt["filter"] = "OCTAHEDRAL"; });
    check("UNRESOLVED_REFERENCE: buffer 7 of 2", [](GltfBuilder&, Json& meshopt) { meshopt["buffer"] = 7; });
    check("BUFFER_VIEW_TOO_LONG", [](GltfBuilder&, Json& meshopt) { meshopt["byteOffset"] = 1 << 30; });
    check("VALUE_NOT_IN_LIST: byteStride 12 of TRIANGLES",
          [](GltfBuilder&, Json& meshopt) { meshopt["mode"] = "TRIANGLES"; });
    check("BUFFER_VIEW_TOO_LONG: bytes 0 + 972 of the 1 of buffer 1", // which has no data of its own
          [](GltfBuilder& builder, Json&) { builder.json["bufferViews"][0].erase("extensions"); });
    check("ACCESSOR_TOO_LONG",
          [](GltfBuilder& builder, Json&) { builder.json["accessors"][0]["count"] = 82; });
    checkDamage(meshoptScene().glb(), 300);
}

TEST_CASE("validate collects the faults of compressed data") {
    GltfBuilder builder = meshoptScene();
    for (const int view : {0, 1}) meshoptOf(builder, view)["byteLength"] = 3;
    const TempFolder folder;
    std::vector<std::string> found;
    for (const Finding& finding : validateScene(folder.write("scene.glb", builder.glb())))
        if (finding.severity == Severity::Error) found.push_back(finding.pointer);
    CHECK(found == std::vector<std::string>{"/bufferViews/0/extensions/EXT_meshopt_compression",
                                            "/bufferViews/1/extensions/EXT_meshopt_compression"});
}

// ---- WebP

namespace {

Bytes webp(int width, int height, bool isLossless, const std::vector<uint8_t>& rgba) {
    uint8_t* encoded = nullptr;
    const size_t size = isLossless ? WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &encoded)
                                   : WebPEncodeRGBA(rgba.data(), width, height, 4 * width, 100, &encoded);
    const Bytes bytes(encoded, encoded + size);
    WebPFree(encoded);
    return bytes;
}

GltfBuilder webpScene(const Bytes& data) {
    GltfBuilder builder;
    builder.mesh(
        {{"attributes", {{"POSITION", builder.vec3(kTriangle)}, {"TEXCOORD_0", builder.vec2(kTriangleUv)}}},
         {"material", 0}});
    builder.json["images"] = {{{"bufferView", builder.view(data)}, {"mimeType", "image/webp"}}};
    builder.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    builder.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    return builder;
}

} // namespace

TEST_CASE("WebP pictures, lossless and lossy, in place of a texture's source") {
    const std::vector<uint8_t> texels{255, 0, 0, 255, 0, 0, 255, 128};
    GltfBuilder builder = webpScene(webp(2, 1, true, texels));
    const Scene scene = load(builder);
    CHECK(scene.notes.warnings.empty());
    REQUIRE(scene.images.size() == 1);
    CHECK(scene.images[0].width == 2);
    CHECK(scene.images[0].rgba == texels);

    const Scene lossy = load(webpScene(webp(8, 8, false, std::vector<uint8_t>(256, 200))));
    CHECK(lossy.images[0].rgba.size() == 256);
    CHECK(std::abs(lossy.images[0].rgba[0] - 200) <= 2);

    builder.json["images"].push_back({{"uri", "gone.png"}}); // for those who do not read WebP
    builder.json["textures"][0]["source"] = 1;
    CHECK(load(builder).images[0].rgba == texels);
    builder.json["textures"][0] = {{"source", 0}}; // without the extension, as some write it
    CHECK(load(builder).images[0].rgba == texels);
}

TEST_CASE("WebP cut short, moving, too large, or not there") {
    std::vector<uint8_t> noise(64 * 64 * 4);
    std::mt19937 random(3);
    for (uint8_t& value : noise) value = static_cast<uint8_t>(random());
    for (const bool isLossless : {true, false}) {
        const Bytes whole = webp(64, 64, isLossless, noise);
        for (size_t size = 12; size < whole.size() - 64; size += whole.size() / 20) {
            CAPTURE(isLossless, size);
            const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            expectError(ExitCode::BadData, "image 0", [&] { load(webpScene(cut)); });
        }
    }
    // An extended header that claims to move, and one of 16,384 x 16,384 pixels.
    const auto extended = [](uint8_t flags, uint8_t high) {
        Bytes bytes{'R', 'I', 'F', 'F', 22, 0, 0, 0, 'W', 'E', 'B', 'P', 'V', 'P', '8', 'X', 10, 0, 0, 0};
        bytes.insert(bytes.end(), {flags, 0, 0, 0, 255, high, 0, 255, high, 0});
        return bytes;
    };
    expectError(ExitCode::BadData, "WebP", [&] { load(webpScene(extended(2, 0))); });
    expectError(ExitCode::BadData, "image 0", [&] { load(webpScene(extended(0, 63))); });
    const Bytes wide = webp(16383, 4097, true, std::vector<uint8_t>(size_t{16383} * 4097 * 4, 7));
    CHECK(wide.size() < 100000);
    expectError(ExitCode::BadData, "16383 x 4097 pixels are more than the", [&] { load(webpScene(wide)); });

    GltfBuilder builder = webpScene(webp(2, 1, true, std::vector<uint8_t>(8, 9)));
    builder.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 4;
    expectError(ExitCode::BadData, "texture 0: UNRESOLVED_REFERENCE: image 4 of 1", [&] { load(builder); });
    checkDamage(webpScene(webp(64, 64, true, noise)).glb(), 100);
}
