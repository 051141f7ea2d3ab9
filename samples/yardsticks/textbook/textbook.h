// Parameters of the textbook kernels.
#ifndef IRRADIA_TEXTBOOK_H
#define IRRADIA_TEXTBOOK_H
#include "shared/types.h"
SHARED_BEGIN

struct TextbookParams {
    uint rows;
    uint weights;
    uint step; // of Adam, from 1
    float learningRate;
    float beta1;
    float beta2;
    float epsilon;
};

SHARED_END
#endif
