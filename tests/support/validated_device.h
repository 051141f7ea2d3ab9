// Devices that suites share, under validation: making one takes a while.
#pragma once

#include "engine/gpu/device.h"

namespace irradia::test {

// One device per form of the records. Never destroyed: the validation layer's own statics are gone before
// ours.
inline Device& deviceWith(RecordAccess records) {
    static Device* devices[2] = {};
    Device*& device = devices[records == RecordAccess::Texel ? 0 : 1];
    if (!device) {
        DeviceOptions options;
        options.validation = true;
        options.records = records;
        device = new Device(options);
    }
    return *device;
}

} // namespace irradia::test
