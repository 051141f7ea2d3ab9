// Path tracing as a method.
#pragma once

#include "nrc/renderer/methods.h"

namespace irradia {

Method pathTracing(); // "pt"

} // namespace irradia
