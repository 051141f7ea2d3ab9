// Numbers of the command line: a text is a number in whole or not at all, in plain decimal digits.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace irradia {

// Digits alone, within [least, most]: no sign, no space, no point, no other base.
std::optional<uint32_t> toWhole(std::string_view text, uint32_t least = 0, uint32_t most = UINT32_MAX);
// A finite decimal number; no NaN, no infinity, nothing after it.
std::optional<double> toNumber(std::string_view text);

// Options that throw Error(Usage) in one sentence, as "--spp 0: not a whole number from 1 to 65536".
CLI::Option* addWhole(CLI::App& command, const std::string& name, uint32_t& value, const std::string& meaning,
                      uint32_t least, uint32_t most);
// A time above 0.
CLI::Option* addSeconds(CLI::App& command, const std::string& name, double& value,
                        const std::string& meaning);
// --subgroup, a power of two; 0 = the device's own.
CLI::Option* addSubgroup(CLI::App& command, uint32_t& size);

} // namespace irradia
