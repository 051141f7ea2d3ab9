// Tables on stdout.
#pragma once

#include <string>
#include <vector>

namespace irradia {

using Row = std::vector<std::string>;

// Columns as wide as their widest cell, the last one open.
void printTable(const std::vector<Row>& rows);

} // namespace irradia
