// Lights of KHR_lights_punctual: as the scene has them, where nodes put them, and what of them is refused.
#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"
#include "tests/support/expect_error.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;
using namespace irradia::test;

namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

// A triangle, and a node for each of the lights.
GltfBuilder lit(const Json& lights, const Json& node = Json::object()) {
    GltfBuilder builder;
    builder.mesh({{"attributes", {{"POSITION", builder.vec3(kTriangle)}}}});
    builder.json["extensionsUsed"] = {kExtension};
    builder.json["extensions"][kExtension]["lights"] = lights;
    for (size_t i = 0; i < lights.size(); ++i) {
        Json placed = node;
        placed["extensions"][kExtension]["light"] = i;
        builder.root(placed);
    }
    return builder;
}

Scene load(const GltfBuilder& builder) {
    const TempFolder folder;
    return loadScene(folder.write("scene.glb", builder.glb()));
}

bool near(glm::vec3 a, glm::vec3 b) {
    return glm::length(a - b) < 1e-6f * (1.0f + glm::length(b));
}

void checkRefused(const std::string& light, const std::string& sentence) {
    expectError(ExitCode::BadData, sentence, [&] { load(lit(Json::array({Json::parse(light)}))); });
}

} // namespace

TEST_CASE("the three kinds, with all that they have and with their defaults") {
    const Scene scene = load(lit(Json::parse(R"([
        {"type": "point", "name": "bulb", "color": [0.5, 1, 0], "intensity": 8, "range": 3},
        {"type": "spot", "intensity": 2, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
        {"type": "directional", "range": 4},
        {"type": "spot", "spot": {}}])"),
                                 {{"name", "stand"}}));
    REQUIRE(scene.lights.size() == 4);
    CHECK(scene.notes.warnings.empty());
    using Kind = PunctualLight::Kind;
    const PunctualLight &point = scene.lights[0], &spot = scene.lights[1], &sun = scene.lights[2];
    CHECK(point.kind == Kind::Point);
    CHECK(point.name == "bulb");
    CHECK(point.intensity == glm::vec3(4, 8, 0));
    CHECK(point.range == 3.0f);
    CHECK(spot.kind == Kind::Spot);
    CHECK(spot.name == "stand");
    CHECK(spot.intensity == glm::vec3(2));
    CHECK(spot.range == 0.0f);
    CHECK(spot.innerAngle == 0.25f);
    CHECK(spot.outerAngle == 0.5f);
    CHECK(sun.kind == Kind::Directional);
    CHECK(sun.intensity == glm::vec3(1));
    CHECK(sun.range == 0.0f); // they have none
    CHECK(scene.lights[3].innerAngle == 0.0f);
    CHECK(scene.lights[3].outerAngle == 0.78539816f);
}

TEST_CASE("nodes place lights: turned and mirrored by the matrix, moved, made neither stronger nor wider") {
    const double h = std::sqrt(0.5);
    const Json lights{{{"type", "spot"}, {"range", 5}, {"spot", Json::object()}}};
    GltfBuilder builder = lit(lights, {{"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}});
    const PunctualLight turned = load(builder).lights.at(0);
    CHECK(turned.position == glm::vec3(1, 2, 3));
    CHECK(near(turned.direction, {-1, 0, 0})); // -Z a quarter turn about +Y

    builder.json["nodes"][1]["scale"] = {7, 3, 0.5};
    const PunctualLight scaled = load(builder).lights.at(0);
    CHECK(near(scaled.direction, {-1, 0, 0}));
    CHECK(scaled.intensity == turned.intensity);
    CHECK(scaled.range == 5.0f);

    builder.json["nodes"].push_back({{"children", {1}}, {"scale", {-2, 4, 1}}});
    builder.json["scenes"][0]["nodes"] = {0, 2};
    const PunctualLight mirrored = load(builder).lights.at(0);
    CHECK(near(mirrored.position, {-2, 8, 3}));
    CHECK(near(mirrored.direction, {1, 0, 0}));

    CHECK(load(lit({{{"type", "directional"}}})).lights.at(0).direction == glm::vec3(0, 0, -1));
}

TEST_CASE("one light at several nodes, lights nobody places, and those without power") {
    GltfBuilder builder = lit({{{"type", "point"}}, {{"type", "point"}, {"intensity", 0}}});
    builder.root({{"extensions", {{kExtension, {{"light", 0}}}}}});
    builder.json["nodes"].push_back({{"extensions", {{kExtension, {{"light", 0}}}}}}); // in no scene
    const Scene scene = load(builder);
    CHECK(scene.lights.size() == 2);
    CHECK(scene.notes.warnings.empty());
    CHECK(load(lit({{{"type", "point"}, {"color", {0, 0, 0}}}})).lights.empty());
}

TEST_CASE("the origin is that of the geometry; of lights only where they are alone") {
    GltfBuilder builder = lit({{{"type", "point"}}}, {{"translation", {1e6, 0, 0}}});
    const Scene scene = load(builder);
    CHECK(scene.origin == glm::dvec3(0));
    CHECK(scene.lights.at(0).position == glm::vec3(1e6f, 0, 0));

    builder.json["nodes"][0]["translation"] = {1e6, 0, 0.25};
    const Scene moved = load(builder);
    CHECK(moved.origin.x > 9e5);
    CHECK(glm::dvec3(moved.lights.at(0).position) + moved.origin == glm::dvec3(1e6, 0, 0));

    builder.json["nodes"][0].erase("mesh");
    const Scene alone = load(builder);
    CHECK(alone.origin == glm::dvec3(1e6, 0, 0));
    CHECK(alone.lights.at(0).position == glm::vec3(0));
}

TEST_CASE("lights with impossible values are refused") {
    checkRefused(R"({"type": "area"})",
                 "light 0: VALUE_NOT_IN_LIST: type 'area', there are point, spot, directional");
    checkRefused(R"({"type": "point", "intensity": -1})", "light 0: VALUE_NOT_IN_RANGE: intensity -1");
    checkRefused(R"({"type": "point", "name": "sun", "range": 0})",
                 "light 0 'sun': VALUE_NOT_IN_RANGE: range 0");
    checkRefused(R"({"type": "point", "range": -2})", "VALUE_NOT_IN_RANGE: range -2 is not above 0");
    checkRefused(R"({"type": "point", "color": [1, 1]})", "ARRAY_LENGTH_NOT_IN_LIST: color of 2 numbers");
    checkRefused(R"({"type": "point", "color": [1, -1, 0]})", "VALUE_NOT_IN_RANGE: color -1 is below 0");
    checkRefused(R"({"type": "spot", "spot": {"innerConeAngle": -0.1}})",
                 "VALUE_NOT_IN_RANGE: innerConeAngle -0.1");
    checkRefused(R"({"type": "spot", "spot": {"outerConeAngle": 1.6}})",
                 "VALUE_NOT_IN_RANGE: outerConeAngle 1.6");
    checkRefused(R"({"type": "spot", "spot": {"outerConeAngle": 0}})",
                 "VALUE_NOT_IN_RANGE: outerConeAngle 0");
    checkRefused(R"({"type": "spot", "spot": {"innerConeAngle": 0.6, "outerConeAngle": 0.5}})",
                 "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES: innerConeAngle 0.6 beyond outerConeAngle 0.5");
    checkRefused(R"({"type": "spot"})", "Spot light description not found");
    checkRefused(R"({"intensity": 1})", "type");
    GltfBuilder builder = lit({{{"type", "point"}}});
    for (const Json& index : {Json(3), Json(-1), Json(0.5), Json(1ull << 32)}) {
        CAPTURE(index.dump());
        builder.json["nodes"][1]["extensions"][kExtension]["light"] = index;
        expectError(ExitCode::BadData,
                    index == Json(3) ? "node 1: UNRESOLVED_REFERENCE: light 3 of 1"
                                     : "/nodes/1/extensions/KHR_lights_punctual/light",
                    [&] { load(builder); });
    }
}

TEST_CASE("a spot with a hard edge, and one of half a sphere as exporters round it") {
    const Json angles{{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}};
    const Scene hard = load(lit({{{"type", "spot"}, {"spot", angles}}}));
    CHECK(hard.lights.size() == 1);
    CHECK(hard.notes.warnings.size() == 1);
    CHECK(load(lit({{{"type", "spot"}, {"spot", {{"outerConeAngle", 1.5707964}}}}})).notes.warnings.empty());
}

TEST_CASE("a light that has lost its orientation is left out with a warning") {
    const Scene scene = load(lit({{{"type", "directional"}}, {{"type", "point"}}}, {{"scale", {0, 0, 0}}}));
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].kind == PunctualLight::Kind::Point);
    REQUIRE(scene.notes.warnings.size() == 1);
    CHECK(scene.notes.warnings[0] == "light 0 is left out: its node has no orientation");
}
