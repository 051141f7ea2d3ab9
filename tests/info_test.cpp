// What `info` tells of a file, on files made here.
#include "engine/error.h"
#include "engine/image/image.h"
#include "engine/scene/load_scene.h"
#include "nrc/learning/model_file.h"
#include "shared/training.h"
#include "tests/gltf_builder.h"
#include "tests/support/lamp_file.h"
#include "tests/support/picture_bytes.h"
#include "tests/support/program_run.h"
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
#include <limits>
#include <sstream>
#include <webp/encode.h>

using namespace irradia;
using namespace irradia::test;

namespace {

std::string contentOf(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
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
    const ProgramRun sheet = irradiaProgram("info " + file.string());
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

    const std::string whole = contentOf(file);
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
    check("a.png", textOf(encodePng({2, 1, std::vector<uint8_t>(8, 255)})), "png");
    const std::string jpeg = textOf(makeJpeg(JpegForm::Colour, 2, 1, std::vector<uint8_t>(6, 99)));
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

    std::string damaged = contentOf(file);
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
