// The encodings there are.
#pragma once

#include "nrc/learning/encodings/kind.h"
#include <deque>

namespace irradia {

// A line of table.cpp each. One more may be appended, before a model that has it is read or made.
std::deque<EncodingKind>& encodingKinds();

// Throws Error(Internal) where there is no such encoding.
const EncodingKind& encodingKind(const std::string& otype);

std::vector<const char*> encodingNames();

} // namespace irradia
