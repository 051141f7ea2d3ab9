// stdin, stdout and stderr as programs find them: maybe closed, full, or a pipe that nobody reads.
#pragma once

#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace irradia {

// First of all in a program: no file that it opens takes the number of a closed stream, and a write that
// nobody reads fails instead of ending the program, as does one beyond the largest file allowed.
void prepareStandardStreams();

// Results go to stdout. What cannot be written is told once, by finishResults(): files come first.
void writeResult(std::string_view text);

template <typename... Args>
void printResult(fmt::format_string<Args...> text, Args&&... args) {
    writeResult(fmt::format(text, std::forward<Args>(args)...));
}

// Throws Error(Io) where stdout did not take everything. A reader that has left had what it wanted.
void finishResults();

} // namespace irradia
