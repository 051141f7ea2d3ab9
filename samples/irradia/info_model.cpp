// irradia info of a saved model.
#include "info.h"
#include "nrc/cache/model_facts.h"
#include "samples/support/sheet.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

nlohmann::ordered_json toJson(const std::filesystem::path& file, const ModelFacts& facts) {
    nlohmann::ordered_json counters = nlohmann::ordered_json::object();
    for (const auto& [name, value] : facts.counters) {
        if (value == std::floor(value) && std::abs(value) < 1e15)
            counters[name] = static_cast<int64_t>(value);
        else
            counters[name] = value;
    }
    auto blocks = nlohmann::ordered_json::array();
    for (const auto& block : facts.blocks) blocks.push_back({{"name", block.name}, {"bytes", block.bytes}});
    const auto configuration = nlohmann::ordered_json::parse(facts.configuration, nullptr, false);
    return {{"file", file.string()},
            {"kind", "model"},
            {"model_kind", facts.kind},
            {"version", facts.version},
            {"predicts", facts.meaning},
            {"shape", facts.shape},
            {"configuration", configuration.is_discarded() ? nlohmann::ordered_json() : configuration},
            {"counters", counters},
            {"blocks", blocks}};
}

// A line for each of encoding, network, loss and optimizer.
std::vector<std::string> configurationLines(const ModelFacts& facts) {
    const auto json = nlohmann::ordered_json::parse(facts.configuration, nullptr, false);
    std::vector<std::string> lines;
    if (json.is_object())
        for (const auto& [key, value] : json.items())
            lines.push_back(fmt::format("{}: {}", key, value.dump()));
    return lines;
}

void printSheet(const std::filesystem::path& file, const ModelFacts& facts) {
    Sheet sheet;
    sheet.add("file", file.string());
    sheet.add("kind", fmt::format("saved model of kind '{}', version {}", facts.kind, facts.version));
    if (!facts.meaning.empty()) sheet.add("predicts", facts.meaning);
    if (!facts.shape.empty()) sheet.add("shape", facts.shape);
    sheet.add("configuration", configurationLines(facts));
    for (const auto& [name, value] : facts.counters) {
        std::string words = name;
        std::ranges::replace(words, '_', ' ');
        sheet.add(words, fmt::format("{:.9g}", value));
    }
    std::vector<std::string> blocks;
    for (const auto& block : facts.blocks)
        blocks.push_back(fmt::format("{}: {} bytes", block.name, block.bytes));
    sheet.add("blocks", blocks);
    sheet.print();
}

} // namespace

void printModelInfo(const std::filesystem::path& file, bool asJson) {
    const ModelFacts facts = modelFacts(ModelFile::read(file));
    if (asJson)
        printJson(toJson(file, facts));
    else
        printSheet(file, facts);
}

} // namespace irradia
