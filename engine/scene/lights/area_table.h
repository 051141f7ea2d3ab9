// Surfaces as an alias table over area, for samples uniform over all of them.
#pragma once

#include "engine/scene/scene_records.h"

namespace irradia {

// Adds the table to a packed scene; only what samples surfaces needs it.
void packAreaTable(SceneRecords& records);

} // namespace irradia
