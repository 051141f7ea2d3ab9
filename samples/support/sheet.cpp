#include "samples/support/sheet.h"

#include "samples/support/standard_streams.h"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace irradia {

namespace {

std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return text;
}

} // namespace

void Sheet::add(const std::string& name, const std::string& value) {
    std::vector<std::string> lines;
    std::istringstream text(value);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    if (lines.empty()) lines.emplace_back();
    add(name, lines);
}

void Sheet::add(const std::string& name, const std::vector<std::string>& values) {
    for (size_t i = 0; i < values.size(); ++i)
        rows_.push_back({i == 0 ? printable(name) : "", printable(values[i])});
}

void printJson(const nlohmann::ordered_json& json) {
    printResult("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace irradia
