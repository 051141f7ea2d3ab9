// What all waves of a frame share (shared/path.h), as `frame` and `camera`.
#ifndef IRRADIA_PATH_FRAME_GLSL
#define IRRADIA_PATH_FRAME_GLSL
#include "shared/path.h"

#define FRAME_CONSTANTS(slot)                             \
    layout(set = 0, binding = slot, std140) uniform Block { \
        FrameConstants frame;                             \
        CameraConstants camera;                           \
    }

#endif
