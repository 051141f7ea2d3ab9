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

constexpr const char* kKind = "cache";
const std::vector<float> kNumbers{1.0f, -0.0f, 3.5e-42f, INFINITY, NAN, 7.0f};

struct Counters {
    uint32_t steps;
    float rate;
};

ModelFile smallModel() {
    ModelFile model(kKind);
    model.addText("shape", "16x2");
    model.add<Counters>("counters", std::vector<Counters>{{123456, 0.1f}});
    model.add<float>("numbers", kNumbers);
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
    expectError(ExitCode::BadData, "changed.model: " + words, [&] { ModelFile::read(file, kKind); });
}

} // namespace

TEST_CASE("a model comes back bit for bit") {
    const TemporaryFolder folder;
    smallModel().write(folder / "a.model");
    CHECK(folder.entries() == 1);
    const ModelFile back = ModelFile::read(folder / "a.model", kKind);
    CHECK(back.text("shape") == "16x2");
    CHECK(back.values<Counters>("counters", 1).front().steps == 123456);
    CHECK(back.values<Counters>("counters", 1).front().rate == 0.1f);
    CHECK(bitsOf(back.values<float>("numbers", 6)) == bitsOf(kNumbers));
    CHECK(back.has("numbers"));
    CHECK(!back.has("number"));

    ModelFile("network").write(folder / "empty.model");
    CHECK_NOTHROW(ModelFile::read(folder / "empty.model", "network"));
}

TEST_CASE("blocks that are missing, of another size or given twice are refused by name") {
    const TemporaryFolder folder;
    smallModel().write(folder / "a.model");
    const ModelFile model = ModelFile::read(folder / "a.model", kKind);
    expectError(ExitCode::BadData, "a.model: holds no block 'cache state'",
                [&] { model.values<float>("cache state", 1); });
    expectError(ExitCode::BadData, "a.model: holds no block 'scene'", [&] { model.text("scene"); });
    expectError(ExitCode::BadData, "a.model: block 'numbers' holds 24 bytes, wanted are 28",
                [&] { model.values<float>("numbers", 7); });
    expectError(ExitCode::BadData, "a.model: block 'numbers' holds 24 bytes, wanted are 8",
                [&] { model.values<Counters>("numbers", 1); });
    ModelFile twice = smallModel();
    expectError(ExitCode::Internal, "two blocks 'numbers'", [&] { twice.add<float>("numbers", kNumbers); });
}

TEST_CASE("a model that is cut off, lengthened or changed anywhere is refused by name") {
    const TemporaryFolder folder;
    smallModel().write(folder / "a.model");
    const std::vector<uint8_t> whole = folder.read("a.model");
    REQUIRE_NOTHROW(ModelFile::read(folder.write("changed.model", whole), kKind));
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
    smallModel().write(folder / "a.model");
    const std::vector<uint8_t> whole = folder.read("a.model");
    const auto with = [&](size_t at, uint8_t value) {
        std::vector<uint8_t> changed = whole;
        changed.at(at) = value;
        return changed;
    };
    checkRefused(folder, with(0, 'X'), "is no model of this program");
    checkRefused(folder, {}, "is no model of this program");
    checkRefused(folder, sealed(with(8, 1)), "is a model of version 1, this program reads version 2");
    checkRefused(folder, with(whole.size() / 2, 0xaa), "the model is damaged");
    checkRefused(folder, {whole.begin(), whole.begin() + 50}, "the model is cut off");
    expectError(ExitCode::BadData, "a.model: is a model of kind 'cache', wanted is one of kind 'network'",
                [&] { ModelFile::read(folder / "a.model", "network"); });
    ModelFile twice("cache");
    twice.addText("first", "1");
    twice.addText("other", "2");
    twice.write(folder / "twice.model");
    std::vector<uint8_t> bytes = folder.read("twice.model");
    const std::string text(bytes.begin(), bytes.end());
    std::memcpy(&bytes[text.find("other")], "first", 5);
    checkRefused(folder, sealed(bytes), "holds the block 'first' twice");
    expectError(ExitCode::NotFound, "none.model", [&] { ModelFile::read(folder / "none.model", kKind); });
    expectError(ExitCode::Io, "not a regular file", [&] { ModelFile::read(folder / ".", kKind); });
}

TEST_CASE("lengths that lie are refused, however large") {
    const TemporaryFolder folder;
    smallModel().write(folder / "a.model");
    const std::vector<uint8_t> whole = folder.read("a.model");
    // The lengths of the kind, the list, a block's name and its bytes, and of the last block.
    const size_t ofKind = 12, ofList = ofKind + 8 + 5, ofName = ofList + 8, ofBytes = ofName + 8 + 5;
    const size_t ofLast = whole.size() - 4 - 6 * sizeof(float) - 8;
    for (const size_t at : {ofKind, ofList, ofName, ofBytes, ofLast})
        for (const uint64_t length :
             {uint64_t{9}, uint64_t{1} << 20, uint64_t{1} << 62, UINT64_MAX, UINT64_MAX / 4 + 7}) {
            std::vector<uint8_t> changed = whole;
            std::memcpy(&changed[at], &length, sizeof length);
            checkRefused(folder, sealed(changed));
        }
}

TEST_CASE("a model is written whole or not at all") {
    const TemporaryFolder folder;
    smallModel().write(folder / "a.model");
    const std::vector<uint8_t> before = folder.read("a.model");
    ModelFile large = smallModel();
    large.add<float>("more numbers", std::vector<float>(100000, 1.0f));

    // A limit on the size of files stands in for a full disk; EFBIG comes instead of a signal.
    const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &limit) == 0);
    rlimit small = limit;
    small.rlim_cur = 8192;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    expectError(ExitCode::Io, "a.model", [&] { large.write(folder / "a.model"); });
    expectError(ExitCode::Io, "new.model", [&] { large.write(folder / "new.model"); });
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, oldHandler);
    CHECK(folder.read("a.model") == before);
    CHECK(folder.entries() == 1);
    expectError(ExitCode::Io, "nowhere", [&] { large.write(folder / "nowhere/a.model"); });
}
