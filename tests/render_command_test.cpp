// `irradia render` as a program: the same command gives the same pixels at any number of threads, files are
// whole, and bad input ends in one sentence and its exit code.
#include "engine/image/display.h"
#include "engine/image/image.h"
#include "nrc/renderer/nrc_config.h"
#include "tests/support/temporary_folder.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <tuple>

using namespace irradia;
using irradia::test::TemporaryFolder;

namespace {

const std::string kScenes = IRRADIA_BIN_DIR "/../scenes/";

struct Run {
    int code = -1;
    std::string log; // stderr
};

Run run(const std::string& environment, const std::string& arguments) {
    const TemporaryFolder folder;
    const std::string log = (folder / "log").string();
    const std::string command =
        environment + " " IRRADIA_BIN_DIR "/irradia " + arguments + " --progress none >/dev/null 2>" + log;
    const int status = std::system(command.c_str());
    std::ifstream file(log);
    return {WEXITSTATUS(status), {std::istreambuf_iterator<char>(file), {}}};
}

} // namespace

// Validation brings the barriers that lavapipe does without.
TEST_CASE("the same command gives the same pixels, with one thread or two, at any slicing, with barriers or "
          "without") {
    const TemporaryFolder folder;
    const std::string arguments =
        "render " + kScenes + "interior.glb --method pt --size 48x36 --frames 3 --max-bounces 6 --aov -o ";
    std::vector<LayeredImage> images;
    for (const char* environment :
         {"LP_NUM_THREADS=1", "LP_NUM_THREADS=2", "LP_NUM_THREADS=2", "IRRADIA_VALIDATION=1"}) {
        const std::string file = (folder / ("image" + std::to_string(images.size()) + ".exr")).string();
        REQUIRE(run(environment, arguments + file).code == 0);
        images.push_back(readExr(file));
    }
    for (const LayeredImage& image : images) CHECK(image.channels == images[0].channels);
    for (const char* name : {"R", "G", "B", "Variance.R", "SampleCount.V", "Albedo.R", "N.X", "P.X", "Z"})
        CHECK(images[0].channels.count(name) == 1);
    for (const char* name : {"version", "device", "driver", "seed", "method", "options", "sceneHash"})
        CHECK(images[0].attributes.count(std::string("irradia.") + name) == 1);
    for (const float v : images[0].channels.at("R")) CHECK(std::isfinite(v));

    // What a pixel saw lies in it: means of its samples, whose cone is convex.
    const glm::mat4 toCamera = images[0].matrices.at("worldToCamera"),
                    toNdc = images[0].matrices.at("worldToNDC");
    const std::vector<glm::vec3> places = images[0].rgb("P", "XYZ");
    for (size_t i = 0; i < places.size(); ++i) {
        const glm::vec4 seen = toNdc * glm::vec4(places[i], 1.0f);
        const glm::vec2 pixel = glm::vec2(seen) / seen.w * glm::vec2(48, 36);
        CHECK(std::abs(pixel.x - (float(i % 48) + 0.5f)) < 0.501f); // positions round
        CHECK(std::abs(pixel.y - (float(i / 48) + 0.5f)) < 0.501f);
        const float depth = images[0].channels.at("Z")[i];
        CHECK(std::abs((toCamera * glm::vec4(places[i], 1.0f)).z - depth) < 1e-4f * depth);
    }
}

TEST_CASE("the cache trains to the same bits with one thread or two, with barriers or without") {
    const TemporaryFolder folder;
    const std::string arguments =
        "render " + kScenes +
        "cornell-box.glb --size 40x30 --frames 6 --warmup 2 --method nrc --preset fast -o ";
    std::vector<LayeredImage> images;
    for (const char* environment : {"LP_NUM_THREADS=1", "LP_NUM_THREADS=2", "IRRADIA_VALIDATION=1"}) {
        const std::string file = (folder / ("image" + std::to_string(images.size()) + ".exr")).string();
        REQUIRE(run(environment, arguments + file).code == 0);
        images.push_back(readExr(file));
    }
    for (const LayeredImage& image : images) CHECK(image.channels == images[0].channels);
    for (const char* name : {"methodOptions", "preset", "model", "trainingSteps"})
        CHECK(images[0].attributes.count(std::string("irradia.") + name) == 1);
}

TEST_CASE("a range of frames is the frames of that number") {
    const TemporaryFolder folder;
    const std::string base =
        "render " + kScenes + "cornell-box.glb --method pt --size 16x16 --max-bounces 2 -o ";
    const auto render = [&](const std::string& frames) {
        const std::string file = (folder / "frames.exr").string();
        REQUIRE(run("", base + file + " --frames " + frames).code == 0);
        return readExr(file).channels.at("G");
    };
    const auto whole = render("0-4"), first = render("0-2"), second = render("2-4");
    for (size_t i = 0; i < whole.size(); ++i)
        CHECK(std::abs(whole[i] - 0.5f * (first[i] + second[i])) <=
              1e-5f * std::max(whole[i], 1.0f)); // sums round
    CHECK(first != second);
}

TEST_CASE("stats say what a frame cost") {
    const TemporaryFolder folder;
    const std::string file = (folder / "stats.json").string();
    REQUIRE(run("", "render " + kScenes + "cornell-box.glb --method pt --size 32x32 --frames 3 -o " +
                        (folder / "o.exr").string() + " --png " + (folder / "o.png").string() + " --stats " +
                        file)
                .code == 0);
    std::ifstream stream(file);
    const auto stats = nlohmann::json::parse(stream);
    CHECK(stats["width"] == 32);
    CHECK(stats["frames"] == 3);
    CHECK(stats["rays"] > 32 * 32);
    CHECK(stats["memory_bytes"] > 0);
    const auto& ms = stats["milliseconds"];
    const double sum = ms["trace_shade"].get<double>() + ms["query"].get<double>() +
                       ms["train"].get<double>() + ms["other"].get<double>();
    CHECK(std::abs(sum - ms["total"].get<double>()) < 1e-6);
    CHECK(std::filesystem::file_size(folder / "o.png") > 100);
    CHECK(stats["options"]["method"] == "pt");
    CHECK(stats["options"]["max_bounces"] == 16);
    CHECK(stats["options"]["sampler"] == "sobol");
    CHECK(readExr(folder / "o.exr").attributes.at("irradia.sampler") == "sobol");
    CHECK(stats["ended_by"] == "frames");
}

TEST_CASE("stats have a row after frames 1, 2, 4, 8, ...") {
    const TemporaryFolder folder;
    const auto rows = [&](const std::string& more) {
        const std::string file = (folder / "stats.json").string();
        REQUIRE(run("", "render " + kScenes + "cornell-box.glb --size 16x12 --stats " + file + more).code ==
                0);
        std::ifstream stream(file);
        return nlohmann::json::parse(stream).at("history");
    };
    const auto learned =
        rows(" --method nrc --preset fast --warmup 2 --frames 5 -o " + (folder / "a.exr").string());
    REQUIRE(learned.size() == 3);
    for (size_t i = 0; i < 3; ++i) {
        CHECK(learned[i]["frame"] == 1u << i);
        CHECK(learned[i]["loss"] > 0.0);
        CHECK(learned[i]["records"] > 0);
        if (i > 0) CHECK(learned[i]["seconds"] > learned[i - 1]["seconds"]);
    }
    const std::string last = (folder / "b.exr").string();
    const auto traced = rows(" --method pt --frames 4 -o " + last);
    REQUIRE(traced.size() == 3);
    CHECK(traced[2]["loss"].is_null());
    double mean = 0.0;
    for (const glm::vec3& pixel : readExr(last).rgb()) mean += luminance(pixel) / (16 * 12);
    CHECK(std::abs(traced[2]["mean"].get<double>() - mean) < 1e-9 * mean); // sums in double precision round
}

TEST_CASE("render takes the cache unless told otherwise, and says so first") {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& more) {
        const std::string file = (folder / "a.exr").string();
        const Run result = run("", "render " + kScenes + "cornell-box.glb --size 8x6 -o " + file + more);
        INFO(result.log);
        REQUIRE(result.code == 0);
        const auto attributes = readExr(file).attributes;
        return std::tuple(result.log.substr(0, result.log.find('\n')), attributes.at("irradia.method"),
                          attributes.at("irradia.warmup"));
    };
    CHECK(render(" --preset fast --frames 2") ==
          std::tuple("render: method nrc, preset fast, warm-up 64, frames 0-2, size 8x6", "nrc", "64 of 64"));
    CHECK(std::get<1>(render(" --method cache-view --preset fast --warmup 3")) == "cache-view");
    CHECK(render(" --max-bounces 0") ==
          std::tuple("render: method pt, warm-up 0, frames 0-1, size 8x6", "pt", "0 of 0"));
    CHECK(std::get<1>(render(" --max-bounces 0 --preset fast --warmup 1")) ==
          "nrc"); // asked for by its options
    CHECK(std::get<1>(render(" --method pt --max-bounces 1")) == "pt");
}

TEST_CASE("time includes the warm-up, which leaves half of it, and there is always a frame") {
    const TemporaryFolder folder;
    const std::string file = (folder / "a.exr").string(), stats = (folder / "a.json").string();
    const Run result =
        run("", "render " + kScenes +
                    "cornell-box.glb --size 64x48 --method nrc --preset fast --warmup 1000000 --time "
                    "0.5 -o " +
                    file + " --stats " + stats);
    INFO(result.log);
    REQUIRE(result.code == 0);
    CHECK(result.log.find("of 1000000 frames, in half of the 0.5 s") != std::string::npos);
    const LayeredImage image = readExr(file);
    CHECK(image.channels.at("SampleCount.V")[0] >= 1.0f);
    CHECK(image.attributes.at("irradia.warmup").ends_with(" of 1000000"));
    CHECK(image.attributes.at("irradia.endedBy") == "time");
    std::ifstream stream(stats);
    const auto json = nlohmann::json::parse(stream);
    CHECK(json.at("warmup_frames") >= 1);
    CHECK(json.at("options").at("warmup") == 1000000);
}

TEST_CASE("an output in place of an input is refused, by whatever name, and the input stays") {
    const TemporaryFolder folder;
    const auto at = [&](const char* name) { return (folder / name).string(); };
    // A triangle whose buffer lies beside the file.
    std::ofstream(at("a.gltf")) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "b.png", "byteLength": 36}]})";
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    folder.write("b.png", {reinterpret_cast<const uint8_t*>(corners.data()), 36});
    LayeredImage sky;
    sky.width = sky.height = 4;
    sky.setRgb("", std::vector<glm::vec3>(16, glm::vec3(1.0f)));
    writeExr(at("sky.exr"), sky);
    std::filesystem::create_symlink("a.gltf", at("link.exr"));
    std::filesystem::create_hard_link(at("a.gltf"), at("hard.exr"));
    std::ofstream(at("camera.json"))
        << R"({"camera": {"position": [0, 0, 3], "look_at": [0, 0, 0], "vfov_deg": 40}, "env": "sky.exr"})";
    const std::pair<const char*, const char*> cases[] = {
        {"-o link.exr", "is the scene"},
        {"-o hard.exr", "is the scene"},
        {"-o ./b.png", "is a file of the scene"},
        {"-o a.exr --stats a.gltf", "is the scene"},
        {"-o a.exr --stats ../$(basename $PWD)/camera.json --camera camera.json", "is the camera"},
        {"-o sky.exr --env sky.exr", "is the environment"},
        {"-o ./sky.exr --env sky.exr:sun", "is the environment"},
        {"-o sky.exr --camera camera.json", "is the environment"},
        {"-o sky.exr --view error-sign --reference sky.exr", "is the reference"},
        {"-o a.exr --stats changes.json --changes changes.json", "is the list of changes"},
    };
    const std::vector<uint8_t> before = folder.read("a.gltf");
    for (const auto& [arguments, sentence] : cases) {
        const Run result =
            run("cd " + at("") + " &&", std::string("render a.gltf --size 4x4 --method pt ") + arguments);
        INFO(arguments << "\n" << result.log);
        CHECK(result.code == 64);
        CHECK(result.log.find(sentence) != std::string::npos);
    }
    CHECK(folder.read("a.gltf") == before);
    CHECK(run("cd " + at("") + " &&", "render a.gltf --size 4x4 --method pt -o a.exr").code == 0);
}

TEST_CASE("a PNG is the picture alone, exposed and mapped as asked") {
    const TemporaryFolder folder;
    const auto at = [&](const char* name) { return (folder / name).string(); };
    const std::string base =
        "render " + kScenes + "cornell-box.glb --method pt --size 16x16 --max-bounces 2 ";
    REQUIRE(run("", base + "-o " + at("a.exr")).code == 0);
    const std::vector<glm::vec3> radiance = readExr(at("a.exr")).rgb();
    const auto pixels = [&](const std::string& options) {
        const Run result = run("", base + "-o " + at("b.png") + options);
        REQUIRE(result.code == 0);
        return std::pair(decodeImage(folder.read("b.png"), "b.png").pixels, result.log);
    };
    CHECK(pixels("").first == toDisplay(16, 16, radiance).pixels);
    CHECK(pixels(" --exposure -1.5 --tonemap aces").first ==
          toDisplay(16, 16, radiance, {.exposure = -1.5, .toneMap = ToneMap::Aces}).pixels);
    const double stops = automaticExposure(radiance);
    const auto [shown, log] = pixels(" --exposure auto --tonemap reinhard");
    CHECK(shown == toDisplay(16, 16, radiance, {.exposure = stops, .toneMap = ToneMap::Reinhard}).pixels);
    char said[32];
    std::snprintf(said, sizeof(said), "exposure: %+.2f stops", stops);
    CHECK(log.find(said) != std::string::npos);
    CHECK(folder.entries() == 2);
}

TEST_CASE("views show numbers of paths, in grey and as a heat map") {
    const TemporaryFolder folder;
    const auto render = [&](const std::string& view) {
        const std::string file = (folder / "view.exr").string(), png = (folder / "view.png").string();
        REQUIRE(
            run("", "render " + kScenes +
                        "cornell-box.glb --size 16x16 --frames 2 --max-bounces 3 --method nrc --preset fast"
                        " --warmup 2 --view " +
                        view + " --png " + png + " -o " + file)
                .code == 0);
        return std::pair(readExr(file).rgb(), decodeImage(folder.read("view.png"), png).pixels);
    };
    const auto [length, shown] = render("path-length");
    const auto [heat, shownHeat] = render("bounce-heat");
    float longest = 0.0f;
    for (size_t i = 0; i < length.size(); ++i) {
        longest = std::max(longest, length[i].r);
        CHECK(length[i] == glm::vec3(length[i].r));
        CHECK(heat[i] == heatColour(length[i].r));
    }
    CHECK(longest >= 2.0f);
    CHECK(longest <= 4.0f);
    CHECK(std::ranges::count(shown, 255) > 256); // beside alpha, the longest
    CHECK(shownHeat == toDisplay(16, 16, heat).pixels);
    for (const glm::vec3& pixel : render("end-vertex").first) CHECK(pixel.r <= 3.0f);
    CHECK(render("training-density").first != length);
}

TEST_CASE("the sign of the error against a reference") {
    const TemporaryFolder folder;
    const auto at = [&](const char* name) { return (folder / name).string(); };
    const std::string base =
        "render " + kScenes + "cornell-box.glb --method pt --size 16x16 --max-bounces 2 -o ";
    REQUIRE(run("", base + at("picture.exr")).code == 0);
    const auto signs = [&](const char* reference) {
        REQUIRE(run("", base + at("signs.exr") + " --view error-sign --reference " + at(reference)).code ==
                0);
        return readExr(at("signs.exr")).rgb();
    };
    for (const glm::vec3& pixel : signs("picture.exr")) CHECK(pixel == glm::vec3(0.0f));

    LayeredImage brighter = readExr(at("picture.exr"));
    const std::vector<glm::vec3> picture = brighter.rgb();
    for (const char* name : {"R", "G", "B"})
        for (float& value : brighter.channels.at(name)) value *= 2.0f;
    writeExr(at("brighter.exr"), brighter);
    const auto darker = signs("brighter.exr");
    for (size_t i = 0; i < picture.size(); ++i) {
        CHECK(darker[i].r == 0.0f);
        CHECK((darker[i].b > 0.0f) == (picture[i] != glm::vec3(0.0f)));
    }
}

namespace {

// Renders small pictures of a box whose lamp a script changes.
class ScriptedBox {
public:
    Run tryRender(const std::string& changes, const std::string& options) const {
        std::ofstream(folder_ / "changes.json") << changes;
        return run("", "render " + kScenes + "cornell-box.glb --size 16x16 --max-bounces 2 -o " +
                           (folder_ / "frames.exr").string() + " --changes " +
                           (folder_ / "changes.json").string() + options);
    }
    LayeredImage render(const std::string& changes, const std::string& options) const {
        const Run result = tryRender(changes, options);
        INFO(result.log);
        REQUIRE(result.code == 0);
        return readExr(folder_ / "frames.exr");
    }

private:
    TemporaryFolder folder_;
};

std::string lampAt(int frame, int strength, const std::string& more = "") {
    return fmt::format(R"({{"frame": {}, "emissive_strength": {{"material": "light", "value": {}}}{}}})",
                       frame, strength, more);
}

} // namespace

TEST_CASE("a scripted change takes place at its frame, and the film begins anew where it is told to") {
    const ScriptedBox box;
    const std::string off = lampAt(3, 0), on = lampAt(5, 4, R"(, "restart": true)");
    const LayeredImage again = box.render("[" + on + "," + off + "]", " --method pt --frames 0-6");
    CHECK(again.attributes.at("irradia.frames") == "5-6");
    CHECK(again.channels.at("SampleCount.V")[0] == 1.0f);

    // Whatever the first frame, it shows the scene as its number says.
    CHECK(box.render("[" + off + "," + on + "]", " --method pt --frames 5-6").channels == again.channels);
    const auto green = [&](const std::string& changes, const std::string& frames) {
        return box.render("[" + changes + "]", " --method pt --frames " + frames).channels.at("G");
    };
    CHECK(green(off, "2-4") != green("", "2-4"));
    for (const float v : green(off, "3-4")) CHECK(v == 0.0f);
    for (const float v : green(off, "30-31")) CHECK(v == 0.0f);
}

TEST_CASE("warm-up sees the scene of the first frame") {
    const ScriptedBox box;
    const auto green = [&](int frame, const std::string& warmup) {
        return box.render("[" + lampAt(frame, 4) + "]", " --method nrc --preset fast --frames 3-4" + warmup)
            .channels.at("G");
    };
    const auto warm = green(3, " --warmup 48");
    CHECK(warm == green(0, " --warmup 48"));
    CHECK(warm != green(3, " --warmup 0")); // it is seen what the cache has learned
}

TEST_CASE("a change that never comes is refused by name") {
    const ScriptedBox box;
    const std::string changes = "[" + lampAt(9, 0) + "," + lampAt(4, 0) + "]";
    const Run late = box.tryRender(changes, " --method pt --frames 2-9");
    INFO(late.log);
    CHECK(late.code == 65);
    CHECK(late.log.find("changes[0].frame is 9, but the last frame rendered is 8") != std::string::npos);
    CHECK(box.tryRender(changes, " --method pt --frames 2-10").code == 0);
}

TEST_CASE("a script that cannot be used is refused in a sentence") {
    const TemporaryFolder folder;
    const std::string script = (folder / "changes.json").string();
    const std::pair<const char*, const char*> cases[] = {
        {"{}", "must be a list"},
        {"[{}]", "changes[0].frame is missing"},
        {R"([{"frame": 1, "emissive_strength": {"material": "nobody", "value": 0}}])",
         "the name of a material"},
        {R"([{"frame": 1, "emissive_strength": {"material": "light"}}])",
         "changes[0].emissive_strength.value"},
        {R"([{"frame": 1}, {"frame": 1, "camera": {"position": [0, 0, 0]}}])", "changes[1].camera.look_at"},
        {R"([{"frame": 1, "environment": 2}])", "no environment to scale"},
        {R"([{"frame": 1, "restart": 1}])", "true or false"},
        {R"([{"frame": 1, "lamp": 1}])", "unknown key changes[0].lamp"},
        {R"([{"frame": 1, "material": {"name": "light", "colour": 1}}])",
         "unknown key changes[0].material.colour, there are name, base_color, roughness, metallic here"},
    };
    for (const auto& [text, sentence] : cases) {
        std::ofstream(script) << text;
        const Run result = run("", "render " + kScenes + "cornell-box.glb -o " + (folder / "o.exr").string() +
                                       " --changes " + script);
        INFO(result.log);
        CHECK(result.code == 65);
        CHECK(result.log.find(sentence) != std::string::npos);
    }
    CHECK(run("", "render " + kScenes + "cornell-box.glb -o o.exr --changes nowhere.json").code == 66);
}

TEST_CASE("a picture says with which preset it was made") {
    const TemporaryFolder folder;
    const auto presetOf = [&](const std::string& options) {
        const std::string file = (folder / "a.exr").string();
        const Run result = run("", "render " + kScenes + "cornell-box.glb --size 8x8 --max-bounces 1 " +
                                       options + " -o " + file);
        INFO(result.log);
        REQUIRE(result.code == 0);
        return readExr(file).attributes.at("irradia.preset");
    };
    const std::string own = (folder / "own.json").string(), model = (folder / "model.json").string();
    std::ofstream(own) << R"({"base": "fast", "training": {"steps": 3}})";
    std::ofstream(model) << R"({"base": "fast", "network": {"n_neurons": 32}})";
    const std::string inherited = presetOf("--method nrc --warmup 1 --preset " + own + " --network " + model);
    NrcConfig expected = nrcPreset("fast");
    expected.steps = 3;
    expected.model.network.width = 32;
    CHECK(parseNrcConfig(inherited, "attribute") == expected);

    // What the picture says renders it again.
    std::ofstream(folder / "again.json") << inherited;
    CHECK(presetOf("--method nrc --warmup 1 --preset " + (folder / "again.json").string()) == inherited);
}

TEST_CASE("a partial preset or model is refused by what it lacks") {
    const TemporaryFolder folder;
    const std::string file = (folder / "part.json").string();
    std::ofstream(file) << R"({"network": {"n_neurons": 64}})";
    const Run network =
        run("", "render " + kScenes + "cornell-box.glb --method nrc --preset balanced --network " + file +
                    " -o " + (folder / "never.exr").string());
    INFO(network.log);
    CHECK(network.code == 65);
    CHECK(network.log.find("part.json: encoding is missing, and no \"base\"") != std::string::npos);
}

TEST_CASE("bad input ends in a sentence and an exit code, and leaves the old file") {
    const TemporaryFolder folder;
    const std::string scene = kScenes + "cornell-box.glb";
    const std::string out = (folder / "out.exr").string();
    std::ofstream(out) << "old";
    const std::string small = (folder / "small.exr").string();
    LayeredImage pixel;
    pixel.width = pixel.height = 1;
    pixel.setRgb("", std::vector{glm::vec3(1.0f)});
    writeExr(small, pixel);
    const std::pair<std::string, int> cases[] = {
        {"render nowhere.glb -o " + out, 66},
        {"render " + scene + " --size 0x5 -o " + out, 64},
        {"render " + scene + " --frames 3-3 -o " + out, 64},
        {"render " + scene + " --method nr-lhs -o " + out, 64},
        {"render " + scene + " --method nrc --preset slow -o " + out, 64},
        {"render " + scene + " --method nrc --network nowhere.json -o " + out, 66},
        {"render " + scene + " --camera nobody -o " + out, 66},
        {"render " + scene + " --device nothing -o " + out, 69},
        {"render " + scene + " --method nrc --view nothing -o " + out, 64},
        {"render " + scene + " --view error-sign -o " + out, 64},
        {"render " + scene + " --reference " + small + " -o " + out, 64},
        {"render " + scene + " --view error-sign --reference nowhere.exr -o " + out, 66},
        {"render " + scene + " --view error-sign --reference " + small + " -o " + out, 65},
        {"render " + scene + " --size 16x16 -o " + (folder / "no/such/folder.exr").string(), 74},
        {"render " + scene, 64},
    };
    for (const auto& [arguments, code] : cases) {
        INFO(arguments);
        const Run result = run("", arguments);
        INFO(result.log);
        CHECK(result.code == code);
        CHECK(result.log.find("irradia: ") != std::string::npos);
    }
    std::ifstream file(out);
    CHECK(std::string(std::istreambuf_iterator<char>(file), {}) == "old");
}
