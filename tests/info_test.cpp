// What `info` tells of a file and `validate` of a scene, on files made here; loading and validation are of
// one mind about what is an error.
#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/scene/load_scene.h"
#include "engine/scene/validate_scene.h"
#include "nrc/learning/model_file.h"
#include "shared/training.h"
#include "tests/gltf_builder.h"
#include "tests/support/picture_bytes.h"
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <sys/wait.h>
#include <webp/encode.h>

using namespace irradia;
using namespace irradia::test;

namespace {

struct Run {
    int code = -1;
    std::string out, err;
};

std::string textOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

Run irradiaProgram(const std::string& arguments) {
    const TempFolder folder;
    const std::string command = IRRADIA_BIN_DIR "/irradia " + arguments + " >" + (folder / "out").string() +
                                " 2>" + (folder / "err").string();
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), textOf(folder / "out"), textOf(folder / "err")};
}

Json jsonOf(const std::string& arguments, int code = 0) {
    const Run run = irradiaProgram(arguments + " --json");
    INFO(arguments << "\n" << run.err);
    REQUIRE(run.code == code);
    return Json::parse(run.out);
}

// A run that ends in one sentence, which names a thing, and has no result.
void checkRefused(const std::string& arguments, int code, const std::string& named) {
    const Run run = irradiaProgram(arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.code == code);
    CHECK(run.out.empty());
    CHECK(run.err.find(named) != std::string::npos);
    CHECK(std::ranges::count(run.err, '\n') == 1);
}

std::string asString(const std::vector<uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

// A lamp of two triangles that stands twice, textured; a camera, a skin, a morph target; extensions of each
// sort.
GltfBuilder lamps() {
    GltfBuilder builder;
    const int positions = builder.vec3({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    const int uv = builder.vec2({{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const int colours = builder.vec3(std::vector<glm::vec3>(4, glm::vec3(0.5f)));
    builder.mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}, {"COLOR_0", colours}}},
                  {"targets", {{{"POSITION", positions}}}},
                  {"indices", builder.indices({0, 1, 2, 0, 2, 3})},
                  {"material", 0}});
    builder.root({{"mesh", 0}, {"translation", {0, 0, 5}}});
    builder.root({{"camera", 0},
                  {"translation", {0, 0, 9}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    const int picture = builder.view(encodePng({3, 2, std::vector<uint8_t>(24, 255)}));
    builder.json["images"] = {{{"bufferView", picture}, {"mimeType", "image/png"}, {"name", "glow"}},
                              {{"uri", "unused.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"emissiveFactor", {1, 1, 1}},
                                  {"emissiveTexture", {{"index", 0}}},
                                  {"alphaMode", "BLEND"},
                                  {"extensions",
                                   {{"KHR_materials_ior", {{"ior", 1.4}}},
                                    {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}}}};
    builder.json["cameras"] = {
        {{"name", "door"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    builder.json["skins"] = {{{"joints", {0}}}};
    builder.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_transmission",
                                      "KHR_lights_punctual", "KHR_materials_sheen", "VENDOR_secret"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}}, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}}}}};
    builder.json["asset"]["generator"] = "a test";
    return builder;
}

using Spoil = std::function<void(Json&)>;

std::filesystem::path spoiled(const TempFolder& folder, const Spoil& spoil) {
    GltfBuilder builder = lamps();
    spoil(builder.json);
    return folder.write("scene.glb", builder.glb());
}

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

TEST_CASE("info counts what a scene holds, as its nodes place it") {
    const TempFolder folder;
    const auto file = folder.write("lamps.glb", lamps().glb());
    const Json info = jsonOf("info " + file.string());
    CHECK(info["kind"] == "scene");
    CHECK(info["format"] == "glb");
    CHECK(info["generator"] == "a test");
    CHECK(info["triangles"] == 4);
    CHECK(info["meshes"] == 1);
    CHECK(info["instances"] == 2);
    CHECK(info["materials"] == 1);
    CHECK(info["pictures_in_file"] == 2);
    CHECK(info["texels"] == 6);
    CHECK(info["pictures"] == Json({{{"name", "glow"}, {"width", 3}, {"height", 2}}}));
    CHECK(info["lights"]["emissive_triangles"] == 4);
    CHECK(info["lights"]["environment"] == false);
    CHECK(info["lights"]["point"] == 0);
    CHECK(info["lights"]["spot"] == 1); // the other stands nowhere
    CHECK(info["lights"]["directional"] == 0);
    CHECK(info["lights"]["ignored"] == 0);
    CHECK(info["masked_materials"] == 0);
    CHECK(info["blended_materials"] == 1);
    CHECK(info["transmissive_materials"] == 1);
    CHECK(info["unlit_materials"] == 0);
    CHECK(info["coloured_primitives"] == 1);
    CHECK(info["cameras"][0]["name"] == "door");
    CHECK(std::abs(info["cameras"][0]["vfov_deg"].get<double>() - 28.6479) < 1e-4);
    CHECK(info["bounds"] == Json({{"lower", {0, 0, 0}}, {"upper", {2, 2, 5}}}));
    CHECK(info["at_rest"] == Json({{"animations", 0}, {"skins", 1}, {"morph_targets", 1}}));
    std::map<std::string, std::string> support;
    for (const Json& extension : info["extensions"]) support[extension["name"]] = extension["support"];
    CHECK(support == std::map<std::string, std::string>{{"KHR_materials_ior", "rendered"},
                                                        {"KHR_materials_transmission", "rendered"},
                                                        {"KHR_lights_punctual", "rendered"},
                                                        {"KHR_materials_sheen", "ignored"},
                                                        {"VENDOR_secret", "unknown"}});
    const Run sheet = irradiaProgram("info " + file.string());
    CHECK(sheet.code == 0);
    CHECK(sheet.err.empty());
    for (const char* line : {"triangles", "'door'", "KHR_materials_sheen: ignored", "1 skin", "3 x 2  glow",
                             "1 spot light", "1, of them 1 blended, 1 transmissive", "of 1 primitive"})
        CHECK(sheet.out.find(line) != std::string::npos);
}

TEST_CASE("info gives bounds where the file has them, far from its origin") {
    const TempFolder folder;
    const auto file = spoiled(folder, [](Json& json) {
        for (int node : {0, 1}) json["nodes"][node]["translation"] = {1e6, 0, 5 * node};
    });
    CHECK(jsonOf("info " + file.string())["bounds"] ==
          Json({{"lower", {1e6, 0, 0}}, {"upper", {1e6 + 2, 2, 5}}}));
}

TEST_CASE("info of an EXR: attributes, those of renders first, layers, and pixels that are not finite") {
    const TempFolder folder;
    LayeredImage image;
    image.width = 4;
    image.height = 3;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const char* name : {"R", "G", "B", "Albedo.R", "Albedo.G", "Albedo.B", "Z"})
        image.channels[name].assign(12, 0.5f);
    image.channels["R"][5] = nan; // twice in one pixel
    image.channels["B"][5] = -std::numeric_limits<float>::infinity();
    image.channels["Z"][11] = std::numeric_limits<float>::infinity();
    image.attributes = {{"irradia.seed", "7"}, {"comment", "blue"}};
    writeExr(folder / "a.exr", image);
    const Json info = jsonOf("info " + (folder / "a.exr").string());
    CHECK(info["format"] == "exr");
    REQUIRE(info["parts"].size() == 1);
    const Json part = info["parts"][0];
    CHECK(part["width"] == 4);
    CHECK(part["height"] == 3);
    CHECK(part["compression"] == "ZIP");
    CHECK(part["nonfinite_pixels"] == 2);
    CHECK(part["layers"] == Json({"Albedo", ""}));
    CHECK(part["channels"].size() == 7);
    CHECK(part["channels"][0]["type"] == "float");
    CHECK(part["attributes"]["irradia.seed"] == "7");
    CHECK(part["attributes"]["comment"] == "blue");
    const std::string sheet = irradiaProgram("info " + (folder / "a.exr").string()).out;
    CHECK(sheet.find("irradia.seed") < sheet.find("comment"));
    CHECK(sheet.find("Albedo: B G R, float") != std::string::npos);
}

TEST_CASE("info of an EXR of two parts, with windows that differ") {
    const TempFolder folder;
    const std::string file = (folder / "parts.exr").string();
    std::vector<Imf::Header> headers;
    for (const char* name : {"colour", "depth"}) {
        const Imath::Box2i display({0, 0}, {19, 9}), data({-2, 1}, {17, 200});
        Imf::Header header(display, data);
        header.setName(name);
        header.setType(Imf::SCANLINEIMAGE);
        header.compression() = Imf::PIZ_COMPRESSION;
        header.channels().insert(name[0] == 'c' ? "Y" : "Z",
                                 Imf::Channel(name[0] == 'c' ? Imf::HALF : Imf::FLOAT));
        header.insert("frame", Imf::IntAttribute(12));
        headers.push_back(header);
    }
    {
        Imf::MultiPartOutputFile output(file.c_str(), headers.data(), 2);
        std::vector<float> values(20 * 200, 1.0f);
        values[20 * 199] = std::numeric_limits<float>::infinity();
        std::vector<half> halves(values.begin(), values.end());
        const auto write = [&](int part, const char* channel, Imf::PixelType type, const void* from) {
            Imf::FrameBuffer frame;
            frame.insert(channel, Imf::Slice::Make(type, from, headers[0].dataWindow()));
            Imf::OutputPart target(output, part);
            target.setFrameBuffer(frame);
            target.writePixels(200);
        };
        write(0, "Y", Imf::HALF, halves.data());
        values[20 * 199] = 1.0f;
        write(1, "Z", Imf::FLOAT, values.data());
    }
    const Json parts = jsonOf("info " + file)["parts"];
    REQUIRE(parts.size() == 2);
    CHECK(parts[0]["name"] == "colour");
    CHECK(parts[0]["channels"][0]["type"] == "half");
    CHECK(parts[0]["nonfinite_pixels"] == 1);
    CHECK(parts[1]["nonfinite_pixels"] == 0);
    CHECK(parts[1]["data_window"] == Json({-2, 1, 17, 200}));
    CHECK(parts[1]["display_window"] == Json({0, 0, 19, 9}));
    CHECK(parts[1]["compression"] == "PIZ");
    CHECK(parts[1]["attributes"]["frame"] == "12");

    const std::string whole = textOf(file);
    checkRefused("info " + folder.write("cut.exr", whole.substr(0, whole.size() / 2)).string(), 65,
                 "cut.exr: not a usable OpenEXR picture");
}

TEST_CASE("info of other pictures is their size") {
    const TempFolder folder;
    const auto check = [&](const std::string& name, const std::string& bytes, const std::string& format) {
        const Json info = jsonOf("info " + folder.write(name, bytes).string());
        CHECK(info["format"] == format);
        CHECK(info["width"] == 2);
        CHECK(info["height"] == 1);
    };
    check("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + std::string(8, '\x80'), "hdr");
    check("a.png", asString(encodePng({2, 1, std::vector<uint8_t>(8, 255)})), "png");
    const std::string jpeg = asString(makeJpeg(JpegForm::Colour, 2, 1, std::vector<uint8_t>(6, 99)));
    check("a.jpg", jpeg, "jpeg");
    check("picture_of_a_wrong_name.txt", jpeg, "jpeg");
    uint8_t* webp = nullptr;
    const std::vector<uint8_t> texels(8, 99);
    const size_t size = WebPEncodeLosslessRGBA(texels.data(), 2, 1, 8, &webp);
    check("a.webp", std::string(webp, webp + size), "webp");
    WebPFree(webp);
    checkRefused("info " + folder.write("cut.jpg", jpeg.substr(0, 20)).string(), 65, "cut.jpg");
}

TEST_CASE("info of a saved model: kind, shape, configuration, counters, blocks") {
    const TempFolder folder;
    gpu::TrainingState state{};
    state.steps = 1234;
    state.loss = 0.5f;
    ModelFile model("cache");
    model.addText("meaning", "radiance");
    model.addText("shape", "16x2");
    model.addText("configuration", R"({"network": {"n_neurons": 16}})");
    model.add<gpu::TrainingState>("counters", std::vector{state});
    model.add<float>("parameters", std::vector<float>(100));
    const std::string file = (folder / "a.model").string();
    model.write(file);
    const Json info = jsonOf("info " + file);
    CHECK(info["kind"] == "model");
    CHECK(info["model_kind"] == "cache");
    CHECK(info["version"] == ModelFile::version());
    CHECK(info["predicts"] == "radiance");
    CHECK(info["shape"] == "16x2");
    CHECK(info["configuration"]["network"]["n_neurons"] == 16);
    CHECK(info["counters"]["steps"] == 1234);
    CHECK(info["counters"]["loss"] == 0.5);
    CHECK(info["blocks"].back() == Json({{"name", "parameters"}, {"bytes", 400}}));
    const std::string sheet = irradiaProgram("info " + file).out;
    for (const char* line : {"kind 'cache'", "1234", "parameters: 400 bytes"})
        CHECK(sheet.find(line) != std::string::npos);

    std::string damaged = textOf(file);
    damaged[damaged.size() - 100] ^= 1;
    checkRefused("info " + folder.write("damaged.model", damaged).string(), 65, "checksum");
    // A block of this name that holds something else has no counters in it.
    ModelFile other("other");
    other.add<float>("counters", std::vector<float>(3));
    other.write(file);
    CHECK(jsonOf("info " + file)["counters"].empty());
}

TEST_CASE("info names a file that it does not know for what it is") {
    const TempFolder folder;
    const auto check = [&](const std::string& name, const std::string& bytes, const std::string& what) {
        const std::string file = folder.write(name, bytes).string();
        checkRefused("info '" + file + "'", 65, file + ": this is " + what);
    };
    check("a.blend", "BLENDER-v300", "a Blender file");
    check("a.obj", "# made\nv 0 0 0\n", "a Wavefront OBJ or MTL file");
    check("a.glb.gz", "\x1f\x8b\x08", "a gzip archive");
    check("a.gif", "GIF89a", "a GIF picture");
    check("view.json", R"({"camera": {}})", "a camera file (render --camera)");
    check("net.json", R"({"encoding": {}, "network": {}})", "a network's configuration (render --network)");
    check("some.json", R"({"a": 1})", "JSON without the \"asset\" of a glTF scene");
    check("notes.txt", "once upon a time\n", "text");
    check("noise.bin", std::string("\x01\x00\x02\x03", 4), "no format known here");
    checkRefused("info " + folder.write("broken.json", "{\"a\": ").string(), 65, "INVALID_JSON");
    checkRefused("info " + folder.write("empty.glb", "").string(), 65, "empty");
    checkRefused("info " + (folder / "gone.exr").string(), 66, "no such file");
    checkRefused("info " + (folder / ".").string(), 74, "not a regular file");
}

TEST_CASE("wrong usage of info and validate is 64") {
    for (const std::string command : {"info", "validate"}) {
        checkRefused(command, 64, "required");
        checkRefused(command + " a.glb --nothing", 64, "--nothing");
        CHECK(irradiaProgram(command + " --help").code == 0);
    }
    checkRefused("info a.exr b.exr", 64, "b.exr");
}

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
    const Run table = irradiaProgram("validate " + file.string());
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
    const Run run = irradiaProgram("validate " + good);
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
