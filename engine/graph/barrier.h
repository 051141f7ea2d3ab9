// The schedule's barriers in Vulkan's words.
#pragma once

#include "engine/graph/schedule.h"
#include <vulkan/vulkan.h>

namespace irradia {

void emitBarrier(VkCommandBuffer commands, const Barrier& barrier);

} // namespace irradia
