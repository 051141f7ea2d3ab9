// What is wrong with the file of a scene, or left out of its picture: one fault of one thing.
#pragma once

#include <string>

namespace irradia {

enum class Severity {
    Error,   // the scene is refused
    Warning, // mended, or left out
    Info     // valid glTF that is not rendered
};

struct Finding {
    Severity severity = Severity::Error;
    std::string code;    // of Khronos' glTF validator, or kNotRendered; empty where neither has a name for it
    std::string pointer; // the place in the JSON (RFC 6901), "/accessors/3/count"; empty = the whole file
    std::string sentence; // "accessor 3 'bark': component type 5"
    std::string message;  // the same as loading says it, code included
};

inline constexpr const char* kNotRendered = "NOT_RENDERED";

} // namespace irradia
