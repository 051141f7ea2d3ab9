// The log: lines on stderr, for whoever watches. A line that cannot be written is dropped; none is worth the
// work.
#pragma once

#include <cstdio>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace irradia {

inline void logText(std::string_view text) {
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr)); // fmt::print would throw
    static_cast<void>(std::fflush(stderr));
}

template <typename... Args>
void logLine(fmt::format_string<Args...> line, Args&&... args) {
    logText(fmt::format(line, std::forward<Args>(args)...) + "\n");
}

} // namespace irradia
