// A file that somebody has named, and what as.
#pragma once

#include <string>

namespace irradia {

struct NamedFile {
    std::string name; // what errors call it: "--png", "the scene"
    std::string file; // empty: not asked for
};

} // namespace irradia
