// A sheet of facts on stdout: names on the left, what they are on the right.
#pragma once

#include "samples/support/table.h"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace irradia {

class Sheet {
public:
    // As many lines as the value has, the name at the first. What a terminal would obey is shown as "?".
    void add(const std::string& name, const std::string& value);
    void add(const std::string& name, const std::vector<std::string>& values); // nothing where there are none
    void print() const { printTable(rows_); }

private:
    std::vector<Row> rows_;
};

// Of a file's texts, which may be no UTF-8: what is none is replaced.
void printJson(const nlohmann::ordered_json& json);

} // namespace irradia
