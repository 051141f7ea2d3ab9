// Runs of the program as a user makes them.
#pragma once

#include "tests/support/temporary_folder.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/wait.h>

namespace irradia::test {

struct ProgramRun {
    int code = -1;
    std::string out, err;
};

inline std::string textOf(const std::vector<uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

inline ProgramRun irradiaProgram(const std::string& arguments) {
    const TemporaryFolder folder;
    const std::string command = IRRADIA_BIN_DIR "/irradia " + arguments + " >" + (folder / "out").string() +
                                " 2>" + (folder / "err").string();
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), textOf(folder.read("out")), textOf(folder.read("err"))};
}

// What it prints as JSON.
inline nlohmann::json jsonOf(const std::string& arguments, int code = 0) {
    const ProgramRun run = irradiaProgram(arguments + " --json");
    INFO(arguments << "\n" << run.err);
    REQUIRE(run.code == code);
    return nlohmann::json::parse(run.out);
}

// A run that ends in one sentence, which names a thing, and has no result; a comparison that failed has its
// numbers.
inline void checkRefused(const std::string& arguments, int code, const std::string& named) {
    const ProgramRun run = irradiaProgram(arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.code == code);
    CHECK(run.out.empty() == (code != 1));
    CHECK(run.err.starts_with("irradia: "));
    CHECK(run.err.find(named) != std::string::npos);
    CHECK(std::ranges::count(run.err, '\n') == 1);
}

} // namespace irradia::test
