// The methods of --method, and which options belong to which: one that the method would pass over is refused.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace irradia {

// Throws Error(Usage) naming the methods there are.
bool methodHasCache(const std::string& method);

// Throws Error(Usage) naming the first option of the command line that is of another method.
void requireOptionsOf(const std::string& method, const CLI::App& command);

} // namespace irradia
