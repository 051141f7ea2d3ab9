// What `validate` tells of a scene, on files made here; loading and validation are of one mind about what is
// an error.
#include "engine/error.h"
#include "engine/scene/load_scene.h"
#include "engine/scene/validate_scene.h"
#include "tests/support/lamp_file.h"
#include "tests/support/program_run.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <limits>
#include <random>

using namespace irradia;
using namespace irradia::test;

namespace {

bool hasErrors(const std::vector<Finding>& findings) {
    return std::ranges::any_of(findings, [](const Finding& f) { return f.severity == Severity::Error; });
}

// The sentence that loading ends with, empty where it loads.
std::string loadingError(const std::filesystem::path& file) {
    try {
        loadScene(file);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("validate lists all faults of a scene, each at its place") {
    const TempFolder folder;
    const auto file = spoiled(folder, [](Json& json) {
        json["accessors"][0]["componentType"] = 5130;
        json["bufferViews"][1]["byteLength"] = 100000;
        json["materials"][0]["emissiveTexture"]["index"] = 5;
        json["meshes"][0]["primitives"][0]["material"] = 9;
        json["cameras"][0]["perspective"]["yfov"] = 7;
        json["nodes"][0]["rotation"] = {0, 0, 0, 0};
        json["nodes"][1]["mesh"] = 3;
        json["scenes"][0]["nodes"] = {0, 0, 2};
    });
    const Json report = jsonOf("validate " + file.string(), 65);
    std::vector<std::pair<std::string, std::string>> found;
    for (const Json& row : report["files"][0]["findings"])
        if (row["severity"] == "error") found.emplace_back(row["code"], row["pointer"]);
    std::ranges::sort(found);
    CHECK(found == std::vector<std::pair<std::string, std::string>>{
                       {"BUFFER_VIEW_TOO_LONG", "/bufferViews/1/byteLength"},
                       {"DUPLICATE_ELEMENTS", "/scenes/0/nodes"},
                       {"ROTATION_NON_UNIT", "/nodes/0/rotation"},
                       {"UNRESOLVED_REFERENCE", "/materials/0/emissiveTexture/index"},
                       {"UNRESOLVED_REFERENCE", "/meshes/0/primitives/0/material"},
                       {"UNRESOLVED_REFERENCE", "/nodes/1/mesh"},
                       {"VALUE_NOT_IN_LIST", "/accessors/0/componentType"},
                       {"VALUE_NOT_IN_RANGE", "/cameras/0/perspective/yfov"}});
    CHECK(report["files"][0]["errors"] == 8);
    const ProgramRun table = irradiaProgram("validate " + file.string());
    CHECK(table.code == 65);
    CHECK(table.err == "irradia: " + file.string() + ": 8 errors\n");
    CHECK(std::ranges::count(table.out, '\n') > 8);
}

TEST_CASE("validate lists the faults of the JSON text, which loading stops at") {
    const TempFolder folder;
    const auto file = spoiled(folder, [](Json& json) {
        json["accessors"][0]["count"] = -1;
        json["accessors"][1]["bufferView"] = "two";
        json["nodes"][0]["mesh"] = 0.5;
    });
    std::vector<std::string> pointers;
    for (const Finding& finding : validateScene(file))
        if (finding.code == "TYPE_MISMATCH") pointers.push_back(finding.pointer);
    CHECK(pointers ==
          std::vector<std::string>{"/accessors/0/count", "/accessors/1/bufferView", "/nodes/0/mesh"});
    CHECK(loadingError(file).find("/accessors/0/count: TYPE_MISMATCH") != std::string::npos);
}

TEST_CASE("validate warns of values of another type, each at its place") {
    const TempFolder folder;
    const auto file = spoiled(folder, [](Json& json) {
        json["materials"][0]["doubleSided"] = 1;
        json["materials"][0]["pbrMetallicRoughness"] = {{"roughnessFactor", std::string(99, 'x')},
                                                        {"baseColorFactor", 0.5}};
        json["materials"][0]["emissiveTexture"]["extensions"]["KHR_texture_transform"]["offset"] = "x";
        json["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionTexture"] = {1};
        json["nodes"][0]["translation"] = "x";
        json["nodes"][0]["mesh"] = Json::object();
        json["nodes"][1]["extensions"]["KHR_lights_punctual"] = "x";
        json["accessors"][0]["normalized"] = nullptr;
        json["extensions"]["KHR_lights_punctual"]["lights"][1]["range"] = "far";
        json["extensions"]["KHR_lights_punctual"]["lights"][1]["spot"]["outerConeAngle"] = {1};
        json["extras"]["materials"] = {{{"doubleSided", 1}}};
    });
    std::vector<std::string> found;
    for (const Finding& finding : validateScene(file))
        if (finding.code == "TYPE_MISMATCH") found.push_back(finding.pointer + " " + finding.sentence);
    const std::string material = "/materials/0/", light = "/extensions/KHR_lights_punctual/lights/1/";
    CHECK(found == std::vector<std::string>{
                       material + "doubleSided 1 is no boolean and is ignored",
                       material + "pbrMetallicRoughness/roughnessFactor \"" + std::string(39, 'x') +
                           "... is no number and is ignored",
                       material + "pbrMetallicRoughness/baseColorFactor 0.5 is no array of numbers and is "
                                  "ignored",
                       material + "extensions/KHR_materials_transmission/transmissionTexture an array is no "
                                  "object and is ignored",
                       material + "emissiveTexture/extensions/KHR_texture_transform/offset \"x\" is no array "
                                  "of numbers and is ignored",
                       "/nodes/0/translation \"x\" is no array of numbers and is ignored",
                       "/nodes/0/mesh an object is no number and is ignored",
                       "/nodes/1/extensions/KHR_lights_punctual \"x\" is no object and is ignored",
                       "/accessors/0/normalized null is no boolean and is ignored",
                       light + "range \"far\" is no number and is ignored",
                       light + "spot/outerConeAngle an array is no number and is ignored"});
    CHECK(loadingError(file).empty());
}

TEST_CASE("validate tells where the parser refuses") {
    const TempFolder folder;
    const auto file = spoiled(folder, [](Json& json) {
        json["accessors"][0]["componentType"] = 99;
        json["accessors"][1].erase("type");
        json["meshes"][0]["primitives"].push_back(Json::object());
        json["cameras"][0]["type"] = "fisheye";
        json["skins"] = 3;
    });
    std::vector<std::string> found;
    for (const Finding& finding : validateScene(file))
        if (finding.severity == Severity::Error) found.push_back(finding.code + " " + finding.pointer);
    CHECK(found == std::vector<std::string>{"VALUE_NOT_IN_LIST /accessors/0/componentType",
                                            "UNDEFINED_PROPERTY /accessors/1/type",
                                            "UNDEFINED_PROPERTY /meshes/0/primitives/1/attributes",
                                            "VALUE_NOT_IN_LIST /cameras/0/type", "TYPE_MISMATCH /skins"});
    CHECK_FALSE(loadingError(file).empty());

    std::vector<std::string> ofNoScene;
    for (const Finding& finding : validateScene(folder.write("view.json", R"({"camera": {"mesh": "a"}})")))
        ofNoScene.push_back(finding.code + " " + finding.pointer);
    CHECK(std::ranges::find(ofNoScene, "UNDEFINED_PROPERTY /asset") != ofNoScene.end());

    const auto missing = spoiled(folder, [](Json& json) {
        json["buffers"] = {{{"uri", "gone.bin"}, {"byteLength", 8}}};
    });
    const std::vector<Finding> findings = validateScene(missing);
    REQUIRE_FALSE(findings.empty());
    CHECK(std::ranges::any_of(
        findings, [](const Finding& f) { return f.code == "IO_ERROR" && f.pointer == "/buffers"; }));
}

TEST_CASE("validate tells where lights, cameras and materials are refused by the parser") {
    const TempFolder folder;
    const auto check = [&](const std::string& expected, const Spoil& spoil) {
        const auto file = spoiled(folder, spoil);
        std::vector<std::string> found;
        for (const Finding& finding : validateScene(file))
            if (finding.severity == Severity::Error) found.push_back(finding.code + " " + finding.pointer);
        CHECK(found == std::vector<std::string>{expected});
        CHECK_FALSE(loadingError(file).empty());
    };
    const auto light = [](Json& json) -> Json& {
        return json["extensions"]["KHR_lights_punctual"]["lights"][1];
    };
    const std::string atLight = " /extensions/KHR_lights_punctual/lights/1";
    check("UNDEFINED_PROPERTY" + atLight + "/type", [&](Json& json) { light(json).erase("type"); });
    check("TYPE_MISMATCH" + atLight + "/type", [&](Json& json) { light(json)["type"] = 3; });
    check("UNDEFINED_PROPERTY" + atLight + "/spot", [&](Json& json) { light(json).erase("spot"); });
    check("TYPE_MISMATCH" + atLight + "/spot", [&](Json& json) { light(json)["spot"] = "wide"; });
    const std::string atMaterial = " /materials/0/";
    check("TYPE_MISMATCH" + atMaterial + "normalTexture",
          [](Json& json) { json["materials"][0]["normalTexture"] = "x"; });
    check("UNDEFINED_PROPERTY" + atMaterial + "pbrMetallicRoughness/baseColorTexture/index", [](Json& json) {
        json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = Json::object();
    });
    check("ARRAY_LENGTH_NOT_IN_LIST" + atMaterial + "emissiveFactor", [](Json& json) {
        json["materials"][0]["emissiveFactor"] = {1, 1};
    });
    check("TYPE_MISMATCH /accessors/0/count", [](Json& json) { json["accessors"][0]["count"] = {1, 2}; });
    const std::string atAttributes = " /meshes/0/primitives/0/attributes";
    check("TYPE_MISMATCH" + atAttributes,
          [](Json& json) { json["meshes"][0]["primitives"][0]["attributes"] = 3; });
    check("TYPE_MISMATCH" + atAttributes + "/POSITION",
          [](Json& json) { json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = Json::object(); });
    const std::string atCamera = " /cameras/0/perspective";
    check("UNDEFINED_PROPERTY" + atCamera, [](Json& json) { json["cameras"][0].erase("perspective"); });
    check("UNDEFINED_PROPERTY" + atCamera + "/znear",
          [](Json& json) { json["cameras"][0]["perspective"].erase("znear"); });
    check("TYPE_MISMATCH" + atCamera + "/yfov",
          [](Json& json) { json["cameras"][0]["perspective"]["yfov"] = "wide"; });
}

TEST_CASE("validate reads indices and pictures too") {
    const TempFolder folder;
    GltfBuilder builder = lamps();
    builder.json["meshes"][0]["primitives"][0]["indices"] = builder.indices({0, 1, 2, 0, 2, 77});
    builder.json["images"][0]["bufferView"] = builder.view(std::vector<uint8_t>(50, 7));
    const auto file = folder.write("scene.glb", builder.glb());
    std::vector<std::string> found;
    for (const Finding& finding : validateScene(file))
        if (finding.severity == Severity::Error) found.push_back(finding.code + " " + finding.pointer);
    CHECK(found == std::vector<std::string>{"IMAGE_DATA_INVALID /images/0",
                                            "ACCESSOR_INDEX_OOB /meshes/0/primitives/0/indices"});
}

TEST_CASE("validate warns of what a renderer can live with, and loading does not") {
    const TempFolder folder;
    GltfBuilder builder = lamps();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = builder.vec3({{0, 0, 1}, {0, 0, 2}, {0, 0, 1.005f}, {0, 0, 0}});
    builder.json["accessors"][0]["min"] = {0, 0, -1};
    builder.json["accessors"][0]["max"] = {2, 2, 0};
    const int packed = builder.accessor(builder.view(std::vector<uint8_t>{7, 0, 200, 9}), 5121, 2, "SCALAR");
    builder.json["accessors"][packed]["normalized"] = true;
    builder.json["accessors"][packed]["byteOffset"] = 1;
    builder.json["accessors"][packed]["max"] = {201};
    const int odd = builder.accessor(builder.view(std::vector<uint8_t>(8)), 5123, 1, "SCALAR");
    builder.json["accessors"][odd]["byteOffset"] = 1;
    builder.json["nodes"].push_back({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    const Json channels = Json::parse(R"([{"sampler": 0, "target": {"path": "translation"}},
        {"sampler": 3, "target": {"node": 3, "path": "rotation"}},
        {"sampler": 0, "target": {"node": 2, "path": "weights"}},
        {"sampler": 0, "target": {"node": 0, "path": "weights"}},
        {"sampler": 0, "target": {"node": 44, "path": "colour"}}])");
    builder.json["animations"] = {{{"channels", channels}, {"samplers", {{{"input", 0}, {"output", 99}}}}}};
    const auto file = folder.write("scene.glb", builder.glb());
    std::vector<std::string> found;
    for (const Finding& finding : validateScene(file))
        if (finding.severity == Severity::Warning) found.push_back(finding.code + " " + finding.pointer);
    const std::string at = "/accessors/" + std::to_string(packed);
    const std::string normals = "/accessors/" + std::to_string(attributes["NORMAL"].get<int>());
    const std::string last = "/accessors/" + std::to_string(odd);
    const std::string channel = "/animations/0/channels/";
    CHECK(found == std::vector<std::string>{
                       "ACCESSOR_MIN_MISMATCH /accessors/0/min/2", "ACCESSOR_MAX_MISMATCH " + at + "/max/0",
                       "ACCESSOR_OFFSET_ALIGNMENT " + last + "/byteOffset",
                       "ACCESSOR_TOTAL_OFFSET_ALIGNMENT " + last, "ACCESSOR_VECTOR3_NON_UNIT " + normals,
                       "UNRESOLVED_REFERENCE /animations/0/samplers/0/output",
                       "UNRESOLVED_REFERENCE " + channel + "1/sampler",
                       "ANIMATION_CHANNEL_TARGET_NODE_MATRIX " + channel + "1/target/node",
                       "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS " + channel + "2/target/node",
                       "UNRESOLVED_REFERENCE " + channel + "4/target/node",
                       "VALUE_NOT_IN_LIST " + channel + "4/target/path"});
    for (const std::string& warning : loadScene(file).notes.warnings)
        CHECK(warning.find("ACCESSOR") == std::string::npos);
}

TEST_CASE("validate takes animations of any shape") {
    const TempFolder folder;
    for (const char* text :
         {R"({"a": [1]})", "3", R"([{"channels": {"a": 1}, "samplers": 2}])",
          R"([{"channels": [{"sampler": 0}, {"sampler": 0, "target": [1]}], "samplers": []}])"}) {
        CAPTURE(text);
        const auto file = spoiled(folder, [&](Json& json) { json["animations"] = Json::parse(text); });
        CHECK(hasErrors(validateScene(file)) == !loadingError(file).empty());
    }
}

TEST_CASE("validate takes several files and passes those without errors") {
    const TempFolder folder;
    const std::string good = folder.write("good.glb", lamps().glb()).string();
    const std::string bad = folder.write("bad.gltf", "{\"asset\": ").string();
    const ProgramRun run = irradiaProgram("validate " + good);
    CHECK(run.code == 0);
    CHECK(run.err.empty());
    CHECK(run.out.find("0 errors, 0 warnings, ") != std::string::npos);
    CHECK(run.out.find(" not rendered (render --strict refuses)\n") != std::string::npos);
    CHECK(run.out.find("NOT_RENDERED") != std::string::npos);
    CHECK(run.out.find("KHR_materials_sheen") != std::string::npos);
    const Json report = jsonOf("validate " + bad + " " + good, 65);
    CHECK(report["files"][0]["findings"][0]["code"] == "INVALID_JSON");
    CHECK(report["files"][1]["errors"] == 0);
    checkRefused("validate " + good + " " + (folder / "gone.glb").string(), 66, "gone.glb: no such file");
    const auto warned = spoiled(
        folder, [](Json& json) { json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 2; });
    CHECK(jsonOf("validate " + warned.string())["files"][0]["warnings"] == 1);
}

TEST_CASE("a scene loads where validation has no errors, and only there") {
    const TempFolder folder;
    const std::string whole = lamps().glb();
    std::mt19937 random(1);
    size_t refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string bytes = whole;
        for (auto k = random() % 3 + 1; k > 0; --k) {
            // Digits by digits, so that most files stay JSON; every fourth time any byte.
            const size_t at = random() % bytes.size();
            if (i % 4 == 0)
                bytes[at] = static_cast<char>(random());
            else if (const size_t digit = bytes.find_first_of("0123456789", at); digit != std::string::npos)
                bytes[digit] = static_cast<char>('0' + random() % 10);
        }
        const auto file = folder.write("scene.glb", bytes);
        const std::vector<Finding> findings = validateScene(file);
        const std::string error = loadingError(file);
        INFO(error << "\n" << (findings.empty() ? "" : findings.front().message));
        CHECK(hasErrors(findings) == !error.empty());
        refused += error.empty() ? 0 : 1;
        // The same fault, or where it lies that the parser refused.
        const auto tells = [&](const Finding& f) {
            return error.find(f.message) != std::string::npos || f.code == "UNDEFINED_PROPERTY" ||
                   f.code == "VALUE_NOT_IN_LIST" || f.code == "TYPE_MISMATCH";
        };
        if (!error.empty()) CHECK(std::ranges::any_of(findings, tells));
    }
    CHECK(refused > 100);
    CHECK(refused < 380);
}
