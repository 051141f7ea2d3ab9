#include "samples/support/numbers.h"

#include "engine/error.h"
#include <bit>
#include <charconv>
#include <cmath>

namespace irradia {

std::optional<uint32_t> toWhole(std::string_view text, uint32_t least, uint32_t most) {
    uint32_t value = 0;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || value < least || value > most) return std::nullopt;
    return value;
}

std::optional<double> toNumber(std::string_view text) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

CLI::Option* addWhole(CLI::App& command, const std::string& name, uint32_t& value, const std::string& meaning,
                      uint32_t least, uint32_t most) {
    const CLI::callback_t read = [&value, name, least, most](const CLI::results_t& texts) {
        const auto whole = toWhole(texts.back(), least, most);
        if (!whole)
            fail(ExitCode::Usage, "{} {}: not a whole number from {} to {}", name, texts.back(), least, most);
        value = *whole;
        return true;
    };
    return command.add_option(name, read, meaning, false, [&value] { return std::to_string(value); })
        ->type_name(most == UINT32_MAX ? "N" : fmt::format("{}..{}", least, most));
}

CLI::Option* addSeconds(CLI::App& command, const std::string& name, double& value,
                        const std::string& meaning) {
    constexpr double kMost = 1e9; // 31 years
    const CLI::callback_t read = [&value, name](const CLI::results_t& texts) {
        const auto seconds = toNumber(texts.back());
        if (!seconds || !(*seconds > 0.0 && *seconds <= kMost))
            fail(ExitCode::Usage, "{} {}: not a number of seconds above 0, with a point for the decimals",
                 name, texts.back());
        value = *seconds;
        return true;
    };
    return command.add_option(name, read, meaning)->type_name("SECONDS");
}

CLI::Option* addSubgroup(CLI::App& command, uint32_t& size) {
    const CLI::callback_t read = [&size](const CLI::results_t& texts) {
        const auto lanes = toWhole(texts.back(), 1, 128);
        if (!lanes || !std::has_single_bit(*lanes))
            fail(ExitCode::Usage, "--subgroup {}: not a power of two from 1 to 128", texts.back());
        size = *lanes;
        return true;
    };
    return command.add_option("--subgroup", read, "Subgroup size to pin")->type_name("LANES");
}

} // namespace irradia
