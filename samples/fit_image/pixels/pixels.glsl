// A pixel as the network sees it: the place of its centre in the unit square.
#include "pixels.h"

vec2 pixelPlace(uint pixel, uint width, uint height) {
    return (vec2(pixel % width, pixel / width) + 0.5) / vec2(width, height);
}
