// The floors of the project, read from the #include lines: a folder includes only lower floors and itself.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

// Files whose path starts with the prefix; the longest prefix counts. Two rooms of one floor never include
// each other.
struct Room {
    std::string_view prefix;
    int floor;
};

constexpr std::array kRooms{
    Room{"engine/error.h", 0},
    Room{"engine/log.h", 0},
    Room{"shaders/shared/", 0}, // layouts, read by C++ and GLSL
    Room{"shaders/lib/", 1},
    Room{"engine/gpu/", 1},
    Room{"engine/image/", 1},
    Room{"engine/graph/", 2},
    Room{"engine/scene/", 2},
    Room{"shaders/path/", 2},     // kernels
    Room{"shaders/learning/", 2}, // kernels
    Room{"shaders/cache/", 2},    // kernels
    Room{"engine/path/", 3},      // meets the next only in the buffers of shaders/shared/cache.h
    Room{"nrc/learning/", 3},
    Room{"nrc/cache/", 4},
    Room{"nrc/samplers/", 5},
    Room{"nrc/renderer/", 6},                // the frame
    Room{"samples/yardsticks/textbook/", 2}, // kernels
    Room{"samples/yardsticks/", 7},          // what the benchmarks compare with
    Room{"samples/support/", 7},             // what the programs share
    Room{"samples/session/", 8},             // a renderer without a command line
    Room{"samples/irradia/", 9},
    Room{"samples/embed/", 9},
    Room{"samples/fit_image/pixels/", 2}, // kernels
    Room{"samples/fit_image/", 9},
    Room{"samples/pictures/", 9},
    Room{"samples/scenes/", 9},
    Room{"tests/", 9},
    Room{"tests/reference/", 9},
};

// Path -> the project's files it includes and, in <>, the others.
using Includes = std::map<std::string, std::vector<std::string>>;

const Room* roomOf(std::string_view path) {
    const Room* best = nullptr;
    for (const Room& room : kRooms)
        if (path.starts_with(room.prefix) && (!best || room.prefix.size() > best->prefix.size()))
            best = &room;
    return best;
}

bool isGlsl(const fs::path& path) {
    return path.extension() == ".glsl" || path.extension() == ".comp";
}

// What an #include names, as a path from the project's root: the search paths of the build, which generates
// kernels/FOLDER.h from that folder's kernels. Outside the project it stays as it is, in <>.
std::string resolve(const fs::path& includer, const std::string& name) {
    static const std::map<std::string, std::string> kGenerated{
        {"kernels/path.h", "shaders/path/"},
        {"kernels/learning.h", "shaders/learning/"},
        {"kernels/cache.h", "shaders/cache/"},
        {"kernels/shaders.h", "tests/shaders/"},
        {"kernels/textbook.h", "samples/yardsticks/textbook/"},
        {"kernels/pixels.h", "samples/fit_image/pixels/"}};
    if (const auto found = kGenerated.find(name); found != kGenerated.end()) return found->second;
    if (!isGlsl(includer) && roomOf(name)) return name;
    if (roomOf("shaders/" + name)) return "shaders/" + name;
    const std::string beside = (includer.parent_path() / name).lexically_normal().generic_string();
    return fs::exists(fs::path(IRRADIA_SOURCE_DIR) / beside) ? beside : fmt::format("<{}>", name);
}

std::vector<std::string> includesIn(const fs::path& path, std::istream& text) {
    static const std::regex kInclude(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
    std::vector<std::string> names;
    std::smatch match;
    for (std::string line; std::getline(text, line);)
        if (std::regex_search(line, match, kInclude)) names.push_back(resolve(path, match[1]));
    return names;
}

Includes projectIncludes() {
    Includes all;
    for (const char* top : {"engine", "nrc", "samples", "shaders", "tests"}) {
        const fs::path folder = fs::path(IRRADIA_SOURCE_DIR) / top;
        if (!fs::exists(folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const fs::path extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp" && !isGlsl(entry.path())) continue;
            std::ifstream text(entry.path());
            const fs::path path = fs::relative(entry.path(), IRRADIA_SOURCE_DIR);
            all[path.generic_string()] = includesIn(path, text);
        }
    }
    return all;
}

bool reaches(const Includes& all, const std::string& path, std::string_view wanted,
             std::set<std::string>& seen) {
    if (path.starts_with(wanted)) return true;
    if (!seen.insert(path).second || !all.contains(path)) return false;
    return std::ranges::any_of(all.at(path),
                               [&](const auto& next) { return reaches(all, next, wanted, seen); });
}

bool mayInclude(const std::string& path, const std::string& included) {
    if (included.starts_with('<')) return true;
    const Room* from = roomOf(path);
    const Room* to = roomOf(included);
    // Path and cache meet in the buffers of shaders/shared alone.
    if (from->prefix == "nrc/cache/" && to && to->prefix == "engine/path/") return false;
    if (from->prefix == "tests/reference/") return from == to || included == "engine/scene/scene.h";
    const bool within = from == to || (from->prefix == "tests/" && to && to->prefix.starts_with("tests/"));
    return within || (to && to->floor < from->floor);
}

// One sentence per include that breaks a rule.
std::vector<std::string> violations(const Includes& all) {
    std::vector<std::string> found;
    for (const auto& [path, includes] : all) {
        if (!roomOf(path)) {
            found.push_back(fmt::format("{} belongs to no floor", path));
            continue;
        }
        for (const std::string& included : includes)
            if (!mayInclude(path, included)) found.push_back(fmt::format("{} includes {}", path, included));
        std::set<std::string> seen;
        if (path.starts_with("engine/graph/schedule.") && reaches(all, path, "<vulkan", seen))
            found.push_back(fmt::format("{} sees Vulkan", path));
    }
    return found;
}

// The project with one line more, at the end of a file that need not exist.
std::vector<std::string> violationsWith(const std::string& path, const std::string& line) {
    Includes all = projectIncludes();
    std::istringstream text(line);
    for (std::string& name : includesIn(path, text)) all[path].push_back(std::move(name));
    return violations(all);
}

} // namespace

TEST_CASE("every floor includes only lower ones") {
    const Includes all = projectIncludes();
    for (const char* top : {"engine/", "samples/", "shaders/", "tests/"}) {
        INFO(top);
        CHECK(std::ranges::any_of(all, [&](const auto& file) { return file.first.starts_with(top); }));
    }
    CHECK(fmt::format("{}", fmt::join(violations(all), "\n")) == "");
}

TEST_CASE("a planted include of a higher floor is found") {
    const std::size_t before = violations(projectIncludes()).size();
    const auto isFound = [&](const char* path, const char* line) {
        INFO(path << ": " << line);
        CHECK(violationsWith(path, line).size() == before + 1);
    };
    isFound("engine/gpu/device.h", "#include \"engine/graph/frame_graph.h\"");
    isFound("engine/gpu/device.h", "#include \"engine/image/image.h\"");
    isFound("engine/scene/scene.h", "  #  include <engine/graph/schedule.h>");
    isFound("engine/path/planted.cpp", "#include \"nrc/learning/trainer.h\"");
    isFound("nrc/learning/trainer.cpp", "#include \"engine/path/wavefront_path_tracer.h\"");
    isFound("nrc/learning/trainer.cpp", "#include \"nrc/renderer/planted.h\"");
    isFound("nrc/cache/planted.cpp", "#include \"engine/path/wave.h\"");
    isFound("engine/scene/planted.cpp", "#include \"kernels/path.h\"");
    isFound("shaders/shared/types.h", "#include \"lib/math.glsl\"");
    isFound("shaders/lib/math.glsl", "#include \"path/scene.glsl\"");
    isFound("shaders/path/planted.comp", "#include \"learning/planted.glsl\"");
    isFound("samples/scenes/planted.cpp", "#include \"samples/irradia/planted.h\"");
    isFound("engine/graph/schedule.cpp", "#include <vulkan/vulkan.h>");
    isFound("tests/reference/planted.cpp", "#include \"engine/scene/bvh/bvh.h\"");
    isFound("tests/reference/planted.cpp", "#include \"shared/types.h\"");
    isFound("elsewhere/planted.cpp", "#include <vector>");
}

TEST_CASE("what the floors allow is not reported") {
    const std::size_t before = violations(projectIncludes()).size();
    const auto isAllowed = [&](const char* path, const char* line) {
        INFO(path << ": " << line);
        CHECK(violationsWith(path, line).size() == before);
    };
    isAllowed("nrc/renderer/planted.cpp",
              "#include \"engine/path/planted.h\"\n#include \"nrc/learning/trainer.h\"");
    isAllowed("nrc/renderer/planted.cpp", "#include \"kernels/learning.h\"\n#include \"shared/cache.h\"");
    isAllowed("tests/planted_test.cpp",
              "#include \"tests/reference/planted.h\"\n#include \"nrc/renderer/planted.h\"");
    isAllowed("tests/shaders/planted.comp", "#include \"lib/math.glsl\"\n#include \"shared/types.h\"");
    isAllowed("tests/reference/planted.cpp", "#include \"engine/scene/scene.h\"\n#include <vector>");
    isAllowed("engine/gpu/device.cpp", "#include <vulkan/vulkan.h>");
}

// ---- sizes ----

namespace {

constexpr int kMostLines = 250; // a file is one idea

std::vector<std::string> longFiles(int most) {
    std::vector<std::string> found;
    for (const auto& [path, includes] : projectIncludes()) {
        if (!path.starts_with("engine/") && !path.starts_with("nrc/") && !path.starts_with("shaders/"))
            continue;
        std::ifstream text(fs::path(IRRADIA_SOURCE_DIR) / path);
        const auto lines = std::count(std::istreambuf_iterator<char>(text), {}, '\n');
        if (lines > most) found.push_back(fmt::format("{} has {} lines", path, lines));
    }
    return found;
}

} // namespace

TEST_CASE("files of the engine, of learning and of shaders are short") {
    CHECK(fmt::format("{}", fmt::join(longFiles(kMostLines), "\n")) == "");
    CHECK_FALSE(longFiles(100).empty()); // of which there are: the test does count
}
