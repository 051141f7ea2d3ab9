// Pictures that are put together must be of one size.
#pragma once

#include "engine/error.h"
#include "engine/image/image.h"
#include <span>

namespace irradia {

inline void requireSameSize(std::span<const LayeredImage> pictures) {
    if (pictures.empty()) fail(ExitCode::Internal, "no pictures to put together");
    const LayeredImage& first = pictures[0];
    for (const LayeredImage& other : pictures)
        if (other.width != first.width || other.height != first.height)
            fail(ExitCode::BadData, "{} has {} x {} pixels, but {} has {} x {}", other.name, other.width,
                 other.height, first.name, first.width, first.height);
}

} // namespace irradia
