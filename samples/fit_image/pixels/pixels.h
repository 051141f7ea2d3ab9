// How the kernels that list and draw pixels get the picture, and what they are told.
#ifndef IRRADIA_FIT_IMAGE_PIXELS_H
#define IRRADIA_FIT_IMAGE_PIXELS_H
#include "shared/types.h"
SHARED_BEGIN

// Of the picture: a record is two pixels in rows, first row on top, each R, G, B (linear) and 0 as halves.
SHARED_CONST uint kPixelsPerRecord = 2u;

struct ListParams {
    uint width;
    uint height;
    uint first; // pixel of row 0
    uint rows;
};

struct DrawParams {
    uint width;
    uint height;
    uint log2Rows; // 2^log2Rows rows are drawn
    uint step;     // key of the random numbers, with the row and the seed
    uint seed;
};

SHARED_END
#endif
