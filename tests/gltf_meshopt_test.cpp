// EXT_meshopt_compression, made here by the library that reads it: whole, cut short, and with counts that
// lie.
#include "engine/scene/validate_scene.h"
#include "tests/support/compressed_files.h"
#include "tests/support/expect_error.h"
#include <functional>
#include <meshoptimizer.h>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

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
