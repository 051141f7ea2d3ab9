// The program as a user meets it: results on stdout, one sentence on stderr, an exit code.
#include "engine/image/image.h"
#include "tests/support/program_run.h"
#include "tests/support/temporary_folder.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <sys/wait.h>

using namespace irradia;
using namespace irradia::test;
using nlohmann::json;

namespace {

// A folder with a picture of 1, one of 1.1, and others.
class Pictures : public TemporaryFolder {
public:
    Pictures() {
        writeFlat("one.exr", 4, 3, 1.0f);
        writeFlat("more.exr", 4, 3, 1.1f);
        writeFlat("small.exr", 2, 2, 1.0f);
        writeFlat("nan.exr", 4, 3, std::numeric_limits<float>::quiet_NaN());
        LayeredImage depth;
        depth.width = depth.height = 1;
        depth.channels["Z"] = {1};
        writeExr(*this / "depth.exr", depth);
        const std::string notExr = "no picture at all";
        write("text.exr", {reinterpret_cast<const uint8_t*>(notExr.data()), notExr.size()});
    }

    std::string at(const std::string& name) const { return (*this / name).string(); }
    std::string pair(const std::string& test, const std::string& reference) const {
        return "compare " + at(test) + " " + at(reference) + " ";
    }

private:
    void writeFlat(const std::string& name, int width, int height, float value) {
        LayeredImage image;
        image.width = width;
        image.height = height;
        image.setRgb("", std::vector<glm::vec3>(static_cast<size_t>(width * height), glm::vec3(value)));
        writeExr(*this / name, image);
    }
};

bool near(double value, double expected) {
    return std::abs(value - expected) < 1e-5 * (1 + std::abs(expected));
}

} // namespace

TEST_CASE("help and version go to stdout") {
    const ProgramRun help = irradiaProgram("--help");
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    for (const char* name : {"render", "compare", "devices", "bench"})
        CHECK(help.out.find(std::string("\n  ") + name + " ") != std::string::npos);
    for (const std::string command : {"", "render ", "bench "})
        CHECK(irradiaProgram(command + "--help").out.find("later") == std::string::npos);
    const ProgramRun version = irradiaProgram("--version");
    CHECK(version.code == 0);
    CHECK(version.out.starts_with("irradia "));
    CHECK(irradiaProgram("compare --help").code == 0);
}

TEST_CASE("wrong usage is one sentence and 64") {
    checkRefused("", 64, "subcommand");
    checkRefused("fly", 64, "unknown subcommand fly");
    checkRefused("compare", 64, "required");
    checkRefused("compare a b c", 64, "c");
    checkRefused("compare a b --blur", 64, "--blur");
    checkRefused("bench", 64, "subcommand");
}

TEST_CASE("options of another method are refused by name, whatever their value") {
    for (const std::string option : {"--preset balanced", "--network a.json", "--warmup 0", "--warmup 8",
                                     "--view prediction", "--view bounce-heat", "--form subgroup"}) {
        const std::string name = option.starts_with("--view") || option.starts_with("--form")
                                     ? option
                                     : option.substr(0, option.find(' '));
        checkRefused("render scene.glb -o a.exr --method pt " + option, 64,
                     name + " is for the methods nrc, cache-view; --method pt has none");
    }
    checkRefused("bench frame scene.glb --method pt --preset fast", 64, "--method pt has none");
    checkRefused("render scene.glb -o a.exr --method none --preset fast", 64,
                 "there are pt, nrc, cache-view");
    // Those of its own it takes: what is missing is the scene.
    checkRefused("render scene.glb -o a.exr --method pt --view error-sign --reference b.exr", 66, "b.exr");
    checkRefused("render scene.glb -o a.exr --method nrc --preset fast --warmup 8", 66, "scene.glb");
}

TEST_CASE("help describes the files that options read") {
    const std::string help = irradiaProgram("render --help").out;
    for (const char* key : {"position", "look_at", "up", "vfov_deg", "env", "base", "frame", "restart"})
        CHECK(help.find('"' + std::string(key) + '"') != std::string::npos);
}

TEST_CASE("every number is one in whole and in range, or refused in one sentence") {
    const std::string render = "render scene.glb -o a.exr ";
    const std::pair<std::string, std::string> cases[] = {
        {render + "--time 1,5", "--time 1,5: not a number of seconds above 0, with a point for the decimals"},
        {render + "--time nan", "--time nan: not"},
        {render + "--time inf", "--time inf: not"},
        {render + "--time 1e400", "--time 1e400: not"},
        {render + "--time 0", "--time 0: not"},
        {render + "--time -3", "--time -3: not"},
        {render + "--time 3s", "--time 3s: not"},
        {render + "--frames -1", "--frames -1: not"},
        {render + "--frames 0", "--frames 0: not"},
        {render + "--frames 3--1", "--frames 3--1: not"},
        {render + "--frames -5--2", "--frames -5--2: not"},
        {render + "--frames 3-3", "--frames 3-3: not"},
        {render + "--frames +3", "--frames +3: not"},
        {render + "--frames 3-", "--frames 3-: not"},
        {render + "--frames 4294967297", "--frames 4294967297: not"},
        {render + "--spp 1e3", "--spp 1e3: not a whole number from 1 to 65536"},
        {render + "--spp 0x10", "--spp 0x10: not"},
        {render + "--spp 0", "--spp 0: not"},
        {render + "--warmup -1", "--warmup -1: not a whole number from 0 to 1000000"},
        {render + "--seed -1", "--seed -1: not"},
        {render + "--seed 4294967296", "--seed 4294967296: not"},
        {render + "--max-bounces 2.5", "--max-bounces 2.5: not a whole number from 0 to 1024"},
        {render + "--size 0x5", "--size 0x5: not"},
        {render + "--size -5x5", "--size -5x5: not"},
        {render + "--size 5x5x5", "--size 5x5x5: not"},
        {render + "--size 5", "--size 5: not"},
        {render + "--subgroup 5", "--subgroup 5: not a power of two"},
        {render + "--subgroup -8", "--subgroup -8: not"},
        {render + "--png a.png --exposure 1,5", "--exposure 1,5: neither"},
        {render + "--png a.png --exposure nan", "--exposure nan: neither"},
        {"bench rays --rounds 0", "--rounds 0: not a whole number from 1 to 10000"},
        {"bench rays --rounds 1e2", "--rounds 1e2: not"},
        {"bench frame scene.glb --frames -1", "--frames -1: not"},
        {"bench mlp --rows 1.5", "--rows 1.5: not"},
        {"bench mlp --inputs +16", "--inputs +16: not"},
        {"bench encodings --rounds 99999", "--rounds 99999: not"},
        {"compare a.exr b.exr --fail-above mse=1,5", "1,5 is not a number"},
        {"compare a.exr b.exr --fail-above mse=nan", "nan is not a number"},
        {"compare a.exr b.exr --fail-above mse=0x10", "0x10 is not a number"},
    };
    for (const auto& [arguments, sentence] : cases) {
        checkRefused(arguments, 64, sentence);
        CHECK(irradiaProgram(arguments).err.size() < 200);
    }
}

TEST_CASE("outputs are refused before the work where they could not be what was asked for") {
    const TemporaryFolder folder;
    const auto at = [&](const std::string& name) { return (folder / name).string(); };
    std::filesystem::create_directory(folder / "folder.exr");
    const std::string scene = IRRADIA_BIN_DIR "/../scenes/cornell-box.glb";
    const std::string render = "render " + scene + " --size 8x8 ";
    checkRefused(render + "-o ''", 64, "-o: the file's name is empty");
    checkRefused(render + "-o " + at("a.exr") + " --png ''", 64, "--png: the file's name is empty");
    checkRefused(render + "-o " + at("a.jpg"), 64, "must end in .exr or .png");
    checkRefused(render + "-o " + at("a"), 64, "must end in .exr or .png");
    checkRefused(render + "-o " + at("a.exr") + " --png " + at("a.exr"), 64, "must end in .png");
    checkRefused(render + "-o " + at("a.exr") + " --stats " + at("a.exr"), 64, "--stats");
    checkRefused(render + "-o " + at("a.png") + " --png " + at("./a.png"), 64, "is the file of -o too");
    checkRefused(render + "-o " + at("folder.exr"), 74, "is a folder");
    checkRefused(render + "-o " + at("no/such/a.exr"), 74, "cannot be written");
    checkRefused(render + "-o " + at("a.exr") + " --exposure 1", 64, "is for PNGs");
    checkRefused(render + "-o " + at("a.png") + " --tonemap filmic", 64, "clip, reinhard, aces");
    checkRefused(render + "-o " + at("a.exr") + " --sampler halton", 64, "there are sobol and random");
    checkRefused(render + "-o " + at("a.png") + " --exposure auto --view path-length", 64, "shows numbers");
    CHECK(folder.entries() == 1);
}

TEST_CASE("compare prints a table or JSON") {
    const Pictures pictures;
    const ProgramRun table = irradiaProgram(pictures.pair("more.exr", "one.exr"));
    CHECK(table.code == 0);
    CHECK(table.err.empty());
    for (const char* name : {"mse ", "relmse ", "mape ", "mean_ratio ", "flip ", "nonfinite "})
        CHECK(table.out.find(name) != std::string::npos);

    const ProgramRun run = irradiaProgram(pictures.pair("more.exr", "one.exr") + "--json");
    CHECK(run.code == 0);
    const json result = json::parse(run.out);
    CHECK(result.size() == 6);
    CHECK(near(result.at("mse"), 0.01));
    CHECK(near(result.at("relmse"), 0.01 / 1.01));
    CHECK(near(result.at("mape"), 0.1 / 1.01));
    CHECK(near(result.at("mean_ratio"), 1.1));
    CHECK(result.at("flip") == 0.0); // both are white on a screen
    CHECK(result.at("nonfinite") == 0);
}

TEST_CASE("compare fails above a limit and only above it") {
    const Pictures pictures;
    const std::string differing = pictures.pair("more.exr", "one.exr");
    CHECK(irradiaProgram(differing + "--fail-above mse=0.011").code == 0);
    CHECK(irradiaProgram(differing + "--fail-above mse=0.011 --fail-above mape=0.2").code == 0);
    CHECK(irradiaProgram(pictures.pair("one.exr", "one.exr") + "--fail-above mse=0").code == 0);
    checkRefused(differing + "--fail-above mse=0.009", 1, "mse 0.01 is above 0.009");
    checkRefused(differing + "--fail-above mse=1 --fail-above mape=0.05", 1, "mape");
    // The option may stand before the files, and the numbers are printed all the same.
    const ProgramRun first = irradiaProgram("compare --json --fail-above mean_ratio=1 " +
                                            pictures.at("more.exr") + " " + pictures.at("one.exr"));
    CHECK(first.code == 1);
    CHECK(near(json::parse(first.out).at("mean_ratio"), 1.1));
}

TEST_CASE("a picture of NaN passes no limit") {
    const Pictures pictures;
    const ProgramRun run =
        irradiaProgram(pictures.pair("nan.exr", "one.exr") + "--json --fail-above mse=1000000");
    CHECK(run.code == 1);
    const json result = json::parse(run.out);
    CHECK(result.at("mse").is_null());
    CHECK(result.at("nonfinite") == 36);
}

TEST_CASE("a value that is not finite fails every metric, and the pixels are counted") {
    const Pictures pictures;
    LayeredImage image = readExr(pictures.at("one.exr"));
    image.channels["G"][5] = std::numeric_limits<float>::infinity();
    image.channels["B"][5] = image.channels["B"][7] = std::numeric_limits<float>::quiet_NaN();
    writeExr(pictures.at("holes.exr"), image);
    const std::string holes = pictures.pair("holes.exr", "one.exr");
    const ProgramRun told = irradiaProgram(holes + "--json");
    CHECK(told.code == 0); // no limit was given
    CHECK(told.err == "warning: 2 of 12 pixels are not finite and in no mean\n");
    CHECK(json::parse(told.out).at("nonfinite") == 3);
    for (const char* metric : {"mse", "relmse", "mape", "mean_ratio", "flip"}) {
        const ProgramRun run = irradiaProgram(holes + "--fail-above " + metric + "=1000");
        CHECK(run.code == 1);
        CHECK(run.err.find(std::string(metric) + " fails by 2 pixels that are not finite") !=
              std::string::npos);
    }
    CHECK(irradiaProgram(holes + "--fail-above nonfinite=3").code == 0);
    CHECK(irradiaProgram(holes + "--fail-above nonfinite=2").code == 1);
}

TEST_CASE("compare warns of a reference whose own noise is in the difference") {
    const Pictures pictures; // relmse of 1.1 to 1: 0.01 / 1.01
    LayeredImage image = readExr(pictures.at("one.exr"));
    const auto errors = [&](float variance) {
        image.setRgb("Variance", std::vector<glm::vec3>(12, glm::vec3(variance)));
        writeExr(pictures.at("noisy.exr"), image);
        const ProgramRun run = irradiaProgram(pictures.pair("more.exr", "noisy.exr"));
        CHECK(run.code == 0);
        return run.err;
    };
    CHECK(errors(0.0005f).empty()); // 5 %
    CHECK(errors(0.002f).find("own noise is a relmse of 0.00198, 20 % of the difference") !=
          std::string::npos);
    CHECK(irradiaProgram(pictures.pair("noisy.exr", "noisy.exr")).err.empty()); // no difference
}

TEST_CASE("compare takes layers and says what it measures") {
    const Pictures pictures;
    LayeredImage image = readExr(pictures.at("more.exr"));
    image.setRgb("glow", std::vector<glm::vec3>(12, glm::vec3(1)));
    writeExr(pictures.at("layers.exr"), image);
    CHECK(irradiaProgram(pictures.pair("layers.exr:glow", "one.exr") + "--fail-above mse=0").code == 0);
    CHECK(irradiaProgram(pictures.pair("layers.exr", "one.exr") + "--fail-above mse=0").code == 1);
    const ProgramRun help = irradiaProgram("compare --help");
    for (const char* words :
         {"mean of (t - r)^2 / (r^2 + 0.01)", "mean of |t - r| / (|r| + 0.01)", "LDR-FLIP"})
        CHECK(help.out.find(words) != std::string::npos);
}

TEST_CASE("--strict makes warnings about the scene errors, before anything is rendered") {
    const TemporaryFolder folder;
    const std::string dark = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]})";
    const std::filesystem::path scene =
        folder.write("dark.gltf", {reinterpret_cast<const uint8_t*>(dark.data()), dark.size()});
    const ProgramRun run = irradiaProgram("render " + scene.string() + " --method pt --strict -o " +
                                          (folder / "a.exr").string());
    CHECK(run.code == 65);
    CHECK(run.err.find("--strict allows no warning, and there is 1: the scene has no light") !=
          std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "a.exr"));
}

TEST_CASE("compare names what it cannot use") {
    const Pictures pictures;
    checkRefused(pictures.pair("one.exr", "none.exr"), 66, "none.exr");
    checkRefused(pictures.pair("text.exr", "one.exr"), 65, "text.exr");
    checkRefused(pictures.pair("depth.exr", "depth.exr"), 65, "depth.exr: has no channel R");
    checkRefused(pictures.pair("one.exr", "nan.exr"), 65,
                 "not finite at 12 of 12 pixels, the first is (0, 0)");
    checkRefused(pictures.pair("one.exr", "small.exr"), 65, "4 x 3");
    checkRefused(pictures.pair("one.exr", "small.exr"), 65, "2 x 2");
    checkRefused(pictures.pair("one.exr", "one.exr") + "--fail-above psnr=3", 64, "psnr");
    checkRefused(pictures.pair("one.exr", "one.exr") + "--fail-above mse", 64, "METRIC=X");
    checkRefused(pictures.pair("one.exr", "one.exr") + "--fail-above mse=much", 64, "much");
}

TEST_CASE("a closed stdout is an error") {
    const Pictures pictures;
    const std::string command =
        IRRADIA_BIN_DIR "/irradia " + pictures.pair("one.exr", "one.exr") + ">/dev/full 2>/dev/null";
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 74);
}

TEST_CASE("devices are listed, or their absence is") {
    const ProgramRun run = irradiaProgram("devices --json");
    const json devices = json::parse(run.out).at("devices");
    CHECK(run.code == (devices.empty() ? 69 : 0));
    for (const json& device : devices) {
        for (const char* key : {"name", "type", "driver", "api"})
            CHECK_FALSE(device.at(key).get<std::string>().empty());
        CHECK(device.at("usable").get<bool>() == device.at("missing").empty());
        CHECK(device.at("subgroup_size").get<int>() > 0);
        CHECK(device.at("memory_bytes").get<uint64_t>() > 0);
    }
    const ProgramRun table = irradiaProgram("devices");
    CHECK(std::ranges::count(table.out, '\n') == std::ptrdiff_t(devices.empty() ? 0 : devices.size() + 1));
}

TEST_CASE("no driver is 69 and a sentence") {
    const std::string command =
        "VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json " IRRADIA_BIN_DIR
        "/irradia devices >/dev/null 2>&1";
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 69);
}

TEST_CASE("render tells its progress as JSON") {
    const TemporaryFolder folder;
    const ProgramRun run = irradiaProgram(
        "render " IRRADIA_BIN_DIR "/../scenes/cornell-box.glb --method nrc --warmup 2 --size 8x8 --frames 3 "
        "--max-bounces 1 --progress json -o " +
        (folder / "a.exr").string());
    INFO(run.err);
    REQUIRE(run.code == 0);
    std::istringstream lines(run.err);
    json last;
    std::set<std::string> tasks;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with('{')) {
            last = json::parse(line);
            tasks.insert(last.at("task"));
        }
    CHECK(tasks == std::set<std::string>{"warmup", "render"});
    CHECK(last.at("task") == "render");
    CHECK(last.at("fraction") == 1.0);
    CHECK(last.at("frames") == 3);
    CHECK(last.at("rate") > 0);
    CHECK(last.at("eta_s") == 0.0);
    CHECK(readExr(folder / "a.exr").width == 8);
}
