// The one exception of the project: a sentence for the user and the exit code it ends the program with.
#pragma once

#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace irradia {

// Exit codes of the command line; 64 and above follow sysexits.h.
enum class ExitCode : int {
    Ok = 0,
    Failed = 1, // a comparison failed
    Usage = 64,
    BadData = 65, // scene or image that cannot be used
    NotFound = 66,
    NoDevice = 69,
    Internal = 70,
    OutOfMemory = 71,
    Io = 74,
    Interrupted = 75, // a checkpoint was written: safe to retry
};

class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& sentence)
        : std::runtime_error(sentence)
        , code_(code) {}
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

// Throws an Error whose sentence names the file and the thing: fail(ExitCode::BadData, "{}: ...", path).
template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> sentence, Args&&... args) {
    throw Error(code, fmt::format(sentence, std::forward<Args>(args)...));
}

} // namespace irradia
