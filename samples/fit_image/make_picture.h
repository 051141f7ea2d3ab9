// A picture to learn, painted by program: smooth gradients, sharp ornaments, writing, and noise at every
// scale down to the pixel, whatever the size. Equal programs paint equal pixels.
#pragma once

#include "engine/image/image.h"

namespace irradia {

Rgba8Image makePicture(glm::uvec2 size);

} // namespace irradia
