// The README keeps to its page, and what the documents name is there.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = IRRADIA_SOURCE_DIR;

std::vector<std::string> linesOf(const fs::path& file) {
    std::ifstream text(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

// Of UTF-8: bytes that do not continue a character.
size_t columns(const std::string& line) {
    return static_cast<size_t>(
        std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// Paths from the project's root, in backticks or as a link's target, and programs of the build.
std::vector<std::string> pathsIn(const std::string& line) {
    static const std::regex kPath(
        R"((?:`|\]\(|build/bin/irradia compare \S+ )((?:shaders|engine|nrc|samples|tests|cmake)/[\w./-]*\w/?))");
    std::vector<std::string> paths;
    for (std::sregex_iterator at(line.begin(), line.end(), kPath), end; at != end; ++at)
        paths.push_back((*at)[1]);
    return paths;
}

std::vector<std::string> absentIn(const std::vector<std::string>& lines) {
    std::vector<std::string> absent;
    for (const std::string& line : lines)
        for (const std::string& path : pathsIn(line))
            if (!fs::exists(kRoot / path) && path.find("NAME") == std::string::npos) absent.push_back(path);
    return absent;
}

} // namespace

TEST_CASE("the README is a page of 130 lines of 110 columns, tables aside") {
    const std::vector<std::string> lines = linesOf(kRoot / "README.md");
    CHECK(lines.size() > 50);
    CHECK(lines.size() <= 130);
    for (const std::string& line : lines) {
        INFO(line);
        CHECK((line.starts_with("|") || columns(line) <= 110));
    }
}

TEST_CASE("every file that the documents name is there") {
    size_t named = 0;
    for (const char* file : {"README.md", "engine/README.md", "nrc/README.md", "shaders/README.md",
                             "tests/README.md", "samples/BENCHMARKS.md"}) {
        const std::vector<std::string> lines = linesOf(kRoot / file);
        INFO(file);
        CHECK_FALSE(lines.empty());
        CHECK(absentIn(lines) == std::vector<std::string>());
        for (const std::string& line : lines) named += pathsIn(line).size();
    }
    CHECK(named > 40);
    CHECK(absentIn({"`shaders/path/planted.comp`"}).size() == 1);
}

TEST_CASE("every suite has its place in the tests' README") {
    std::string text;
    for (const std::string& line : linesOf(kRoot / "tests/README.md")) text += line + "\n";
    for (const auto& entry : fs::directory_iterator(kRoot / "tests")) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with("_test.cpp")) continue;
        INFO(name);
        CHECK(text.find("`" + name.substr(0, name.size() - 9) + "`") != std::string::npos);
    }
}
