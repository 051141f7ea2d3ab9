// irradia devices: what Vulkan offers here, and what keeps a device from being used.
#include "commands.h"
#include "engine/error.h"
#include "engine/gpu/device.h"
#include "samples/support/standard_streams.h"
#include "samples/support/table.h"
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

std::string state(const DeviceDescription& device) {
    return device.missing.empty() ? "usable" : fmt::format("lacks {}", fmt::join(device.missing, ", "));
}

Row toRow(const DeviceDescription& device) {
    constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;
    return {std::to_string(device.index),
            device.name,
            device.type,
            device.driver,
            device.apiVersion,
            std::to_string(device.subgroupSize),
            fmt::format("{:.1f} GiB", static_cast<double>(device.memoryBytes) / kGibibyte),
            state(device)};
}

nlohmann::ordered_json toJson(const DeviceDescription& device) {
    return {{"index", device.index},
            {"name", device.name},
            {"type", device.type},
            {"driver", device.driver},
            {"api", device.apiVersion},
            {"subgroup_size", device.subgroupSize},
            {"memory_bytes", device.memoryBytes},
            {"usable", device.missing.empty()},
            {"missing", device.missing}};
}

void printDevices(bool asJson) {
    const std::vector<DeviceDescription> devices = listDevices();
    if (asJson) {
        auto list = nlohmann::ordered_json::array();
        for (const DeviceDescription& device : devices) list.push_back(toJson(device));
        printResult("{}\n", nlohmann::ordered_json{{"devices", list}}.dump(2));
    } else if (!devices.empty()) {
        std::vector<Row> rows{{"#", "name", "type", "driver", "API", "subgroup", "memory", "state"}};
        for (const DeviceDescription& device : devices) rows.push_back(toRow(device));
        printTable(rows);
    }
    if (devices.empty())
        fail(ExitCode::NoDevice,
             "no Vulkan device; Mesa's lavapipe (mesa-vulkan-drivers) is one for any CPU");
}

} // namespace

void addDevices(CLI::App& program) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command =
        program.add_subcommand("devices", "List the Vulkan devices and whether each can be used");
    command->add_flag("--json", *json, "Print JSON instead of a table");
    command->callback([json] { printDevices(*json); });
}

} // namespace irradia
