// A long room with exhibits on pedestals, to be lit by many lamps.
#pragma once

#include "glb_writer.h"
#include "room.h"

namespace irradia::scenes {

constexpr Room kGallery{{-6.0f, 0.0f, -2.5f}, {6.0f, 3.6f, 2.5f}};

void addGalleryShell(GlbWriter& glb);
void addGalleryExhibits(GlbWriter& glb);
void addGalleryCameras(GlbWriter& glb);

// Where step i of n lies between two ends, half a step from each.
float spread(uint32_t i, uint32_t n, float lower, float upper);

} // namespace irradia::scenes
