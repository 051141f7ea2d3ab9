// The subcommands of `irradia`. Each adds itself to the program with its options, and runs when it was named.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace irradia {

void addRender(CLI::App& program);
void addCompare(CLI::App& program);
void addDevices(CLI::App& program);
void addInfo(CLI::App& program);
void addValidate(CLI::App& program);
void addBench(CLI::App& program);
void addBenchFrame(CLI::App& bench);
void addBenchRays(CLI::App& bench);
void addBenchMlp(CLI::App& bench);
void addBenchEncodings(CLI::App& bench);

} // namespace irradia
