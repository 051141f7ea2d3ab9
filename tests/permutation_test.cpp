// The permutation that shuffles records: a bijection for every count and key, and one that mixes.
#include "kernels/shaders.h"
#include "tests/reference/permutation.h"
#include "tests/reference/statistics.h"
#include "tests/shaders/harness.h"
#include "tests/support/kernel_harness.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;

namespace {

std::vector<uint32_t> permutationOf(uint32_t count, uint32_t key) {
    static test::KernelHarness kernel(kernels::permute);
    std::vector<uint32_t> list;
    for (const glm::uvec4& record : kernel.run({}, gpu::PermuteParams{count, key}, count, count))
        list.push_back(record.x);
    return list;
}

} // namespace

TEST_CASE("each record is drawn exactly once") {
    const uint32_t counts[] = {1,  2,  3,   4,    5,    7,     8,     15,    16,    17,      63,
                               64, 65, 255, 1000, 4096, 16383, 16384, 16385, 65537, 1u << 18};
    for (const uint32_t count : counts)
        for (const uint32_t key : {0u, 1u, 0x9e3779b9u}) {
            INFO("count " << count << ", key " << key);
            CHECK(reference::isPermutation(permutationOf(count, key)));
        }
    std::vector<uint32_t> planted = permutationOf(1000, 1);
    planted[17] = planted[18];
    CHECK(!reference::isPermutation(planted));
}

// A batch is a stretch of the permutation: it must be as good as a random subset. Counted is how many records
// of each sixteenth of the input land in each sixteenth of the output, over 256 keys.
TEST_CASE("every part of the records is spread evenly over the batches") {
    constexpr uint32_t kParts = 16, kCount = 1u << 14, kKeys = 256;
    std::vector<double> counts(kParts * kParts);
    for (uint32_t key = 0; key < kKeys; ++key) {
        const std::vector<uint32_t> list = permutationOf(kCount, key);
        for (uint32_t i = 0; i < kCount; ++i)
            counts[i / (kCount / kParts) * kParts + list[i] / (kCount / kParts)] += 1.0;
    }
    const std::vector<double> expected(counts.size(), double(kKeys) * kCount / (kParts * kParts));
    // Rows and columns have fixed sums, so that the statistic is a little smaller than its distribution: a
    // weak mix shows as a large one, a constant mix as none.
    const double p = reference::chiSquareTest(counts, expected).pValue;
    CHECK(p > 0.01);
    CHECK(p < 1.0 - 1e-9);
    counts[0] += 0.1 * expected[0]; // the test has the power to see one part in ten
    CHECK(reference::chiSquareTest(counts, expected).pValue < 0.01);
}

TEST_CASE("keys give different permutations") {
    CHECK(permutationOf(1000, 1) == permutationOf(1000, 1));
    CHECK(permutationOf(1000, 1) != permutationOf(1000, 2));
}
