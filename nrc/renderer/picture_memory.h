// What a picture takes of a device's memory, known before any scene is loaded.
#pragma once

#include "nrc/renderer/methods.h"

namespace irradia {

// All buffers of a method's renderer; where the device's memory is the machine's also the picture that is
// read back.
std::vector<Device::PlannedBuffer> pictureBuffers(const Device& device, const MethodSetup& setup);

// Throws Error(OutOfMemory) naming the largest size of the picture's shape that fits, where its own does not.
void requireRoomForPicture(const Device& device, const MethodSetup& setup);

} // namespace irradia
