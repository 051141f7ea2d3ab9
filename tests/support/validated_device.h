// Devices that suites share, under validation: making one takes a while.
#pragma once

#include "engine/gpu/device.h"

namespace irradia::test {

// One device per form of the quads. Never destroyed: the validation layer's own statics are gone before
// ours.
inline Device& deviceWith(QuadAccess quads) {
    static Device* devices[2] = {};
    Device*& device = devices[quads == QuadAccess::Texel ? 0 : 1];
    if (!device) {
        DeviceOptions options;
        options.validation = true;
        options.quads = quads;
        device = new Device(options);
    }
    return *device;
}

} // namespace irradia::test
