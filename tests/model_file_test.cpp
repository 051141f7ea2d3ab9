// Models on disk: what is written comes back bit for bit, what is not whole is refused by name, and no half
// file is left.
#include "nrc/learning/model_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <csignal>
#include <cstring>
#include <sys/resource.h>
#include <zlib.h>

using namespace irradia;
using irradia::test::expectError;
using irradia::test::TemporaryFolder;

namespace {

const std::string kShape = "a network 16x2 with 5 inputs";

ModelFile smallModel() {
    ModelFile model{kShape, R"({"network": {}})", {}, {1.0f, -0.0f, 3.5e-42f, INFINITY, NAN, 7.0f}};
    model.state.steps = 123456;
    model.state.eta2 = 0.1f;
    model.state.meanTarget = 9;
    return model;
}

std::vector<uint32_t> bitsOf(const std::vector<float>& values) {
    std::vector<uint32_t> bits;
    for (const float v : values) bits.push_back(std::bit_cast<uint32_t>(v));
    return bits;
}

// With its checksum made right again.
std::vector<uint8_t> sealed(std::vector<uint8_t> bytes) {
    const size_t end = bytes.size() - sizeof(uint32_t);
    const auto sum = static_cast<uint32_t>(crc32_z(0, bytes.data(), end));
    std::memcpy(&bytes[end], &sum, sizeof sum);
    return bytes;
}

void checkRefused(const TemporaryFolder& folder, const std::vector<uint8_t>& bytes,
                  const std::string& words = "") {
    const auto file = folder.write("changed.model", bytes);
    expectError(ExitCode::BadData, "changed.model: " + words, [&] { readModel(file, kShape, 6); });
}

} // namespace

TEST_CASE("a model comes back bit for bit") {
    const TemporaryFolder folder;
    const ModelFile model = smallModel();
    writeModel(folder / "a.model", model);
    CHECK(folder.entries() == 1);
    const ModelFile back = readModel(folder / "a.model", kShape, 6);
    CHECK(back.shape == model.shape);
    CHECK(back.config == model.config);
    CHECK(std::memcmp(&back.state, &model.state, sizeof model.state) == 0);
    CHECK(bitsOf(back.content) == bitsOf(model.content));

    writeModel(folder / "empty.model", {});
    CHECK(readModel(folder / "empty.model", "", 0).content.empty());
}

TEST_CASE("a model that is cut off, lengthened or changed anywhere is refused by name") {
    const TemporaryFolder folder;
    writeModel(folder / "a.model", smallModel());
    const std::vector<uint8_t> whole = folder.read("a.model");
    REQUIRE_NOTHROW(readModel(folder.write("changed.model", whole), kShape, 6));
    for (size_t size = 0; size < whole.size(); ++size)
        checkRefused(folder, {whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)});
    for (size_t i = 0; i < whole.size(); ++i)
        for (const uint8_t flip : {uint8_t{0x01}, uint8_t{0x80}}) {
            std::vector<uint8_t> changed = whole;
            changed[i] ^= flip;
            checkRefused(folder, changed);
        }
    std::vector<uint8_t> longer = whole;
    longer.push_back(0);
    checkRefused(folder, longer);
}

TEST_CASE("a refusal says what differs") {
    const TemporaryFolder folder;
    writeModel(folder / "a.model", smallModel());
    const std::vector<uint8_t> whole = folder.read("a.model");
    const auto with = [&](size_t at, uint8_t value) {
        std::vector<uint8_t> changed = whole;
        changed.at(at) = value;
        return changed;
    };
    checkRefused(folder, with(0, 'X'), "is no model of this program");
    checkRefused(folder, {}, "is no model of this program");
    checkRefused(folder, sealed(with(8, 2)), "is a model of version 2, this program reads version 1");
    checkRefused(folder, with(whole.size() / 2, 0xaa), "the model is damaged");
    checkRefused(folder, {whole.begin(), whole.begin() + 50}, "the model is cut off");
    expectError(ExitCode::BadData,
                "a.model: holds a model of a network 16x2 with 5 inputs, wanted is one of 64x5",
                [&] { readModel(folder / "a.model", "64x5", 6); });
    expectError(ExitCode::BadData, "a.model: holds 6 numbers, wanted are 7",
                [&] { readModel(folder / "a.model", kShape, 7); });
    expectError(ExitCode::NotFound, "none.model", [&] { readModel(folder / "none.model", kShape, 6); });
    expectError(ExitCode::Io, "not a regular file", [&] { readModel(folder / ".", kShape, 6); });
}

TEST_CASE("lengths that lie are refused, however large") {
    const TemporaryFolder folder;
    writeModel(folder / "a.model", smallModel());
    const std::vector<uint8_t> whole = folder.read("a.model");
    const size_t ofShape = 12, ofConfig = ofShape + 8 + kShape.size();
    const size_t ofContent = whole.size() - 4 - 6 * sizeof(float) - 8;
    for (const size_t at : {ofShape, ofConfig, ofContent})
        for (const uint64_t length :
             {uint64_t{7}, uint64_t{1} << 20, uint64_t{1} << 62, UINT64_MAX, UINT64_MAX / 4 + 7}) {
            std::vector<uint8_t> changed = whole;
            std::memcpy(&changed[at], &length, sizeof length);
            checkRefused(folder, sealed(changed));
        }
}

TEST_CASE("a model is written whole or not at all") {
    const TemporaryFolder folder;
    writeModel(folder / "a.model", smallModel());
    const std::vector<uint8_t> before = folder.read("a.model");
    ModelFile large = smallModel();
    large.content.assign(100000, 1.0f);

    // A limit on the size of files stands in for a full disk; EFBIG comes instead of a signal.
    const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &limit) == 0);
    rlimit small = limit;
    small.rlim_cur = 8192;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    expectError(ExitCode::Io, "a.model", [&] { writeModel(folder / "a.model", large); });
    expectError(ExitCode::Io, "new.model", [&] { writeModel(folder / "new.model", large); });
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, oldHandler);
    CHECK(folder.read("a.model") == before);
    CHECK(folder.entries() == 1);
    expectError(ExitCode::Io, "nowhere", [&] { writeModel(folder / "nowhere/a.model", large); });
}
