// --method, and which options belong to which method: one that the method would pass over is refused.
#pragma once

#include "nrc/renderer/methods.h"
#include <CLI/CLI.hpp>

namespace irradia {

// --method, and the options of all methods' own, whose values go into `given`.
void addMethodOptions(CLI::App& command, std::string& method, std::map<std::string, std::string>& given);

// The method that is named; where none is, the usual one that takes all options of the command line.
std::string chooseMethod(const std::string& named, uint32_t maxBounces, const CLI::App& command);

// Throws Error(Usage) naming the first option of the command line that is of other methods.
void requireOptionsOf(const std::string& method, const CLI::App& command);

// "--preset 'balanced' --network ''": all of the method's own.
std::string optionsText(const Method& method, const std::map<std::string, std::string>& given);

} // namespace irradia
