// Surfaces as an alias table over area, for samples uniform over all of them.
#pragma once

#include "engine/scene/packed_scene.h"

namespace irradia {

// Adds the table to a packed scene; only what samples surfaces needs it.
void packAreaTable(PackedScene& packed);

} // namespace irradia
