// What a device reaches at most by a kernel of multiply-adds alone.
#pragma once

#include "engine/gpu/device.h"

namespace irradia {

// GFLOP/s, a multiply-add counted as two; best of a few runs of about `seconds`.
double measureDevicePeak(Device& device, double seconds = 0.05);

} // namespace irradia
