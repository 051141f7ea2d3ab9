// How a batch is cut into chunks and parts: whole chunks in each part, all rows once, whatever the number of
// records, and no chunk larger than any device's binding holds.
#include "nrc/learning/batch_rows.h"
#include "tests/reference/random.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>

using namespace irradia;

TEST_CASE("parts of a batch are whole chunks that cover its rows, for every size") {
    reference::Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const auto wanted = static_cast<uint32_t>(std::exp2(21.0 * random.uniform()));
        const auto most = gpu::kRowPadding * static_cast<uint32_t>(1 + 300 * random.uniform());
        const BatchRows batch(wanted, most);
        const uint32_t chunk = chunkRows(batch.rows);
        INFO(wanted << " rows in parts of at most " << most);
        CHECK(batch.rows >= wanted);
        CHECK(batch.rows % gpu::kRowPadding == 0);
        CHECK(batch.partRows <= std::max(most, chunk));
        CHECK(chunk <= kLargestChunk);
        uint32_t covered = 0;
        for (uint32_t first = 0; first < batch.rows; first += batch.partRows) {
            const RowRange part = batch.partFrom(first);
            CHECK(part.first == covered);
            CHECK(part.first % chunk == 0);
            covered += part.rows;
            CHECK((covered % chunk == 0 || covered == batch.rows));
        }
        CHECK(covered == batch.rows);
    }
}
