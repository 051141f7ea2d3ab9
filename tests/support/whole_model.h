// A model's JSON of which a test gives only what it is about.
#pragma once

#include <string>

namespace irradia::test {

// The model of these sections, with what their kinds need besides: identity encoding, a network of 64x5, L2
// and Adam where a section is missing.
std::string wholeModel(const std::string& sections);

} // namespace irradia::test
