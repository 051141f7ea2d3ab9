// A run that is asked to end keeps what it has: the frames so far, or the old file.
#include "engine/image/image.h"
#include "tests/support/running_program.h"
#include "tests/support/temporary_folder.h"
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

using namespace irradia;
using irradia::test::RunningProgram;
using irradia::test::TemporaryFolder;

namespace {

std::vector<std::string> render(const TemporaryFolder& folder, const std::vector<std::string>& more,
                                const std::string& size = "16x16") {
    std::vector<std::string> all{IRRADIA_BIN_DIR "/irradia",
                                 "render",
                                 IRRADIA_BIN_DIR "/../scenes/cornell-box.glb",
                                 "--size",
                                 size,
                                 "--max-bounces",
                                 "2",
                                 "--progress",
                                 "json",
                                 "-o",
                                 (folder / "a.exr").string(),
                                 "--png",
                                 (folder / "a.png").string(),
                                 "--stats",
                                 (folder / "a.json").string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

void writeOld(const TemporaryFolder& folder) {
    const std::string old = "old";
    folder.write("a.exr", {reinterpret_cast<const uint8_t*>(old.data()), old.size()});
}

bool isOld(const TemporaryFolder& folder) {
    return folder.read("a.exr") == std::vector<uint8_t>{'o', 'l', 'd'};
}

} // namespace

TEST_CASE("a signal ends a render after the frame in flight, and the frames so far are written") {
    for (const auto& [signal, name] :
         {std::pair(SIGINT, "SIGINT"), {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}}) {
        const TemporaryFolder folder;
        writeOld(folder);
        RunningProgram program(render(folder, {"--method", "pt", "--time", "600"}), folder / "log");
        REQUIRE(program.waitForLog("\"task\":\"render\""));
        program.send(signal);
        program.send(signal); // as timeout(1) does: one request
        CHECK(program.wait() == 75);
        INFO(program.log());
        CHECK(program.log().find(std::string("irradia: interrupted by ") + name) != std::string::npos);

        const LayeredImage image = readExr(folder / "a.exr");
        const float samples = image.channels.at("SampleCount.V")[0];
        CHECK(samples >= 1.0f);
        CHECK(image.attributes.at("irradia.endedBy") == name);
        CHECK(decodeImage(folder.read("a.png"), "a.png").width == 16);
        const std::vector<uint8_t> bytes = folder.read("a.json");
        const auto stats = nlohmann::json::parse(bytes.begin(), bytes.end());
        CHECK(stats.at("ended_by") == name);
        CHECK(stats.at("frames") == samples);
        CHECK(folder.entries() == 4); // no temporary file stays
    }
}

TEST_CASE("a render that is interrupted before its first frame writes nothing and leaves the old file") {
    const TemporaryFolder folder;
    writeOld(folder);
    RunningProgram program(render(folder, {"--method", "nrc", "--preset", "fast", "--warmup", "1000000"}),
                           folder / "log");
    REQUIRE(program.waitForLog("\"task\":\"warmup\""));
    program.send(SIGINT);
    CHECK(program.wait() == 75);
    INFO(program.log());
    CHECK(program.log().find("of 1000000 frames of warm-up: nothing is written") != std::string::npos);
    CHECK(isOld(folder));
    CHECK(folder.entries() == 2);
}

TEST_CASE("a second signal ends a render at once") {
    const TemporaryFolder folder;
    writeOld(folder);
    // A frame of minutes.
    RunningProgram program(render(folder, {"--method", "pt", "--spp", "256"}, "1024x1024"), folder / "log");
    REQUIRE(program.waitForLog("memory:"));
    std::this_thread::sleep_for(
        std::chrono::seconds(3)); // the frame has begun: before it one signal is enough
    program.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // so that it is a second request
    program.send(SIGTERM);
    CHECK(program.wait() == -SIGTERM);
    CHECK(isOld(folder));
}

TEST_CASE("a program under nohup outlives its terminal") {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = render(folder, {"--method", "pt", "--time", "1"});
    arguments.insert(arguments.begin(), "/usr/bin/nohup");
    RunningProgram program(arguments, folder / "log");
    REQUIRE(program.waitForLog("render: method pt"));
    program.send(SIGHUP);
    CHECK(program.wait() == 0);
    CHECK(readExr(folder / "a.exr").attributes.at("irradia.endedBy") == "time");
}
