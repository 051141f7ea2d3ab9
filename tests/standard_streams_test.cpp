// The log may be lost, results may not; no file is, whatever stdout and stderr are.
#include "engine/image/image.h"
#include "tests/support/temporary_folder.h"
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <sys/wait.h>

using namespace irradia;
using irradia::test::TemporaryFolder;

namespace {

int exitCode(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Exit code of a render whose streams the shell redirects so; its picture must be there, whole.
int renderWith(const std::string& redirections) {
    const TemporaryFolder folder;
    const std::string picture = (folder / "a.exr").string();
    const int code =
        exitCode("bash -o pipefail -c '" IRRADIA_BIN_DIR "/irradia render " IRRADIA_BIN_DIR
                 "/../scenes/cornell-box.glb --size 8x8 --method pt "
                 "--max-bounces 1 --frames 2 --progress json -o " +
                 picture + " --stats " + (folder / "a.json").string() + " " + redirections + "'");
    INFO(redirections);
    CHECK(readExr(picture).channels.at("SampleCount.V")[0] == 2.0f);
    CHECK(folder.read("a.json").back() == '\n');
    CHECK(folder.entries() == 2);
    return code;
}

} // namespace

TEST_CASE("a log that cannot be written is dropped") {
    CHECK(renderWith(">/dev/null 2>/dev/full") == 0);
    CHECK(renderWith(">/dev/null 2>&-") == 0);
    CHECK(renderWith("<&- >/dev/null 2>&-") == 0);
    CHECK(renderWith("2>&1 >/dev/null | true") == 0);
    CHECK(renderWith("2>&1 | head -n 1 >/dev/null") == 0); // who left has read enough
}

TEST_CASE("a stdout that cannot be written is 74, and the files are there") {
    CHECK(renderWith(">/dev/full 2>/dev/null") == 74);
    CHECK(renderWith(">&- 2>/dev/null") == 74);
    CHECK(renderWith("<&- >&- 2>&-") == 74);
}

TEST_CASE("help that cannot be written is 74 too") {
    for (const char* program :
         {"irradia --help", "irradia render --help", "fit_image --help", "make_scenes --help"})
        CHECK(exitCode(std::string(IRRADIA_BIN_DIR "/") + program + " >/dev/full 2>/dev/null") == 74);
}

TEST_CASE("a full disk leaves the old file") {
    const TemporaryFolder folder;
    const std::string old = "old";
    const std::string picture =
        folder.write("a.png", {reinterpret_cast<const uint8_t*>(old.data()), old.size()}).string();
    // A limit on files is what a test can have of it, and the CPU driver dies of one: so a program without
    // it.
    CHECK(exitCode("bash -c 'ulimit -f 8; " IRRADIA_BIN_DIR "/fit_image --make-picture " + picture +
                   " >/dev/null 2>/dev/null'") == 74);
    CHECK(folder.read("a.png") == std::vector<uint8_t>{'o', 'l', 'd'});
    CHECK(folder.entries() == 1);
}

TEST_CASE("the sample programs explain themselves and refuse what they do not know") {
    const TemporaryFolder folder;
    const std::string in = "cd " + (folder / "").string() + " && " IRRADIA_BIN_DIR "/";
    const std::string quiet = " >/dev/null 2>/dev/null";
    for (const char* program : {"make_scenes", "fit_image"}) {
        CHECK(exitCode(in + program + " --help" + quiet) == 0);
        CHECK(exitCode(in + program + quiet) == 64);
        CHECK(exitCode(in + program + " --fast" + quiet) == 64);
        CHECK(exitCode(in + program + " a b c" + quiet) == 64);
        CHECK(exitCode(in + program + " ''" + quiet) == 64);
    }
    CHECK(folder.entries() == 0);
}
