// The files of a command line, before any work: an output must be writable, have its ending, and be neither
// an input nor another output, by whatever path or link it is named.
#pragma once

#include "samples/support/named_file.h"
#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <vector>

namespace irradia {

// An option whose name of a file may not be empty.
CLI::Option* addOutput(CLI::App& command, const std::string& name, std::string& file,
                       const std::string& meaning);

// Whether the name ends so, in small letters or large.
bool hasEnding(const std::string& file, const std::string& ending);
// Throws Error(Usage) where the file is named and has none of the endings.
void requireEnding(const NamedFile& output, std::initializer_list<const char*> endings);

// Throws Error(Usage) naming both options. "-" is stdout.
void requireApart(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);
// The same, and Error(Io) for what cannot be written.
void checkOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

} // namespace irradia
