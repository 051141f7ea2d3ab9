#include "tests/support/kernel_harness.h"

#include <cstdlib>
#include <string_view>

namespace irradia::test {

Device& validatedDevice() {
    // Never destroyed: the validation layer's own statics are gone before ours.
    static Device* device = [] {
        DeviceOptions options;
        options.validation = true;
        return new Device(options);
    }();
    return *device;
}

bool fullSweep() {
    const char* value = std::getenv("IRRADIA_FULL");
    return value && std::string_view(value) == "1";
}

KernelHarness::KernelHarness(const KernelSource& source, const std::vector<Specialisation>& constants)
    : kernel_(validatedDevice(), source, [&] {
        KernelOptions options;
        options.constants = constants;
        return options;
    }()) {}

Buffer quadBuffer(const std::vector<glm::uvec4>& records) {
    return makeBuffer(validatedDevice(), "records", records);
}

Buffer quadBuffer(const std::vector<glm::vec4>& records) {
    return makeBuffer(validatedDevice(), "records", records);
}

} // namespace irradia::test
