// `irradia bench mlp` and `bench encodings` give the numbers that programs read. How fast anything is, is not
// asked.
#include "tests/support/temporary_folder.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <sys/wait.h>

using irradia::test::TemporaryFolder;
using nlohmann::json;

namespace {

struct Run {
    int code = -1;
    std::string out;
    std::string err;
};

std::string contentOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

Run bench(const std::string& arguments) {
    const TemporaryFolder folder;
    const std::string command = IRRADIA_BIN_DIR "/irradia bench " + arguments + " >" +
                                (folder / "out").string() + " 2>" + (folder / "err").string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder / "out"),
            contentOf(folder / "err")};
}

Run benchMlp(const std::string& arguments) {
    return bench("mlp --quick " + arguments);
}

void checkPositive(const json& entry, const char* key) {
    INFO(key << " of " << entry.dump());
    REQUIRE(entry.contains(key));
    REQUIRE(entry.at(key).is_number());
    CHECK(std::isfinite(entry.at(key).get<double>()));
    CHECK(entry.at(key) > 0);
}

} // namespace

TEST_CASE("bench mlp gives its numbers as JSON") {
    const Run run = benchMlp("--shape 16x1 --inputs 16 --rows 300 --train-rows 300 --form subgroup --json -");
    INFO(run.err);
    REQUIRE(run.code == 0);
    const json result = json::parse(run.out);
    std::set<std::string> cases;
    for (const json& entry : result.at("mlp")) {
        CHECK(entry.at("width") == 16);
        CHECK(entry.at("hidden") == 1);
        CHECK(entry.at("form") == "subgroup");
        for (const char* key : {"rows_per_second", "gflops", "peak_ratio", "textbook_ratio", "bytes_per_row",
                                "bytes_per_row_unfused", "gb_per_second"})
            checkPositive(entry, key);
        REQUIRE(entry.contains("onednn_ratio"));
        if (!entry.at("onednn_ratio").is_null()) checkPositive(entry, "onednn_ratio");
        checkPositive(entry.at("milliseconds"), "wall");
        CHECK_FALSE(entry.at("passes").empty());
        // Half precision carries 11 bits; what differs is 16 products deep.
        if (entry.at("mode") == "inference") CHECK(entry.at("difference") < 0.01);
        cases.insert(entry.at("mode").get<std::string>() + " " + entry.at("precision").get<std::string>());
    }
    CHECK(cases ==
          std::set<std::string>{"inference float", "inference half", "training float", "training half"});
    checkPositive(result, "peak_gflops");
    checkPositive(result, "threads");
    CHECK_FALSE(result.at("device").get<std::string>().empty());
}

TEST_CASE("bench mlp prints a line a case") {
    const Run run = benchMlp("--shape 16x1 --inputs 16 --rows 300 --mode inference --precision float");
    INFO(run.err);
    REQUIRE(run.code == 0);
    for (const char* word : {"shape", "of peak", "oneDNN", "16x1", "subgroup", "workgroup"})
        CHECK(run.out.find(word) != std::string::npos);
}

TEST_CASE("bench mlp tells first executions") {
    const Run run = benchMlp("--shape 16x1 --inputs 16 --mode inference --precision float --form subgroup "
                             "--compile-times --json -");
    INFO(run.err);
    REQUIRE(run.code == 0);
    const json result = json::parse(run.out);
    REQUIRE(result.at("compile_times").size() >= 2);
    for (const json& entry : result.at("compile_times")) {
        checkPositive(entry, "cold_seconds");
        checkPositive(entry, "cached_seconds");
        CHECK_FALSE(entry.at("kernel").get<std::string>().empty());
    }
}

TEST_CASE("bench mlp names what it cannot use") {
    for (const char* shape : {"64", "64x", "x5", "0x2", "64x9", "64x2x2", "big"}) {
        const Run run = benchMlp(std::string("--shape ") + shape);
        CHECK(run.code == 64);
        CHECK(run.err.find(std::string("--shape ") + shape) != std::string::npos);
    }
    const Run odd = benchMlp("--shape 48x2 --rows 300");
    INFO(odd.err);
    CHECK(odd.code == 65);
    CHECK(odd.err.find("48x2") != std::string::npos);
}

TEST_CASE("bench encodings gives its numbers as JSON") {
    const Run run = bench("encodings --rows 300 --rounds 1 --json -");
    INFO(run.err);
    REQUIRE(run.code == 0);
    const json result = json::parse(run.out);
    REQUIRE(result.at("encodings").size() >= 4);
    for (const json& entry : result.at("encodings"))
        for (const char* key : {"width", "milliseconds", "ns_per_row", "time_ratio"})
            checkPositive(entry, key);
    CHECK(result.at("rows") == 300);
}
