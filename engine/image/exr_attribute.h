// The values of OpenEXR's attributes as text.
#pragma once

#include <ImfAttribute.h>
#include <ImfCompression.h>
#include <string>

namespace irradia {

// Numbers with a space between, rows of matrices with a comma; of a type without a text its name in brackets.
std::string textOf(const Imf::Attribute& attribute);

std::string nameOfCompression(Imf::Compression compression);

} // namespace irradia
