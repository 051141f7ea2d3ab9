#include "samples/support/table.h"

#include "samples/support/standard_streams.h"
#include <algorithm>

namespace irradia {

void printTable(const std::vector<Row>& rows) {
    if (rows.empty()) return;
    std::vector<size_t> widths(rows.front().size());
    for (const Row& row : rows)
        for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    for (const Row& row : rows) {
        for (size_t c = 0; c + 1 < row.size(); ++c) printResult("{:<{}}  ", row[c], widths[c]);
        printResult("{}\n", row.back());
    }
}

} // namespace irradia
