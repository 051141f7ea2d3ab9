// Parameters of multiply_adds.
#ifndef IRRADIA_DEVICE_PEAK_H
#define IRRADIA_DEVICE_PEAK_H
#include "shared/types.h"
SHARED_BEGIN

SHARED_CONST uint kPeakSums = 3u;    // vectors of four: what fits 16 vector registers, and hides the latency
SHARED_CONST uint kPeakUnroll = 16u; // multiply-adds of each in an iteration

struct DevicePeakParams {
    uint iterations;
    float factor; // below 1, so that the sums neither overflow nor become denormal
    float term;
};

SHARED_END
#endif
