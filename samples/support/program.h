// What every program does around its work: whatever went wrong becomes a sentence on stderr and an exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <glm/glm.hpp>
#include <string>

namespace irradia {

// Runs `work`, which adds the options and parses the command line; returns the exit code.
int runProgram(const std::string& description, const std::string& name,
               const std::function<void(CLI::App& program)>& work);

// "WxH" of --size, each from 1 to 16384. Throws Error(Usage).
glm::uvec2 parseSize(const std::string& text);

} // namespace irradia
