// KHR_draco_mesh_compression, made here by the library that reads it: whole, cut short, and with counts that
// lie.
#include "tests/support/compressed_files.h"
#include "tests/support/expect_error.h"
#include <draco/compression/encode.h>
#include <functional>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

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
