// What the device's arithmetic may lose more than a CPU's, for tolerances.
#pragma once

#include "tests/support/kernel_harness.h"

namespace irradia::test {

// How many times a CPU's rounding of a division, half a unit, the device's may be: Vulkan allows a GPU 2.5
// units.
inline double divisionSlack() {
    return validatedDevice().isCpu() ? 1.0 : 5.0;
}

} // namespace irradia::test
