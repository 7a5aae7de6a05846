// All kinds of force devices.
#include "device/force_devices.hpp"

#include <array>
#include <variant>

#include "core/files/plain_text.hpp"
#include "force_device_list.hpp"

namespace dibhr {

std::span<const ForceDeviceKind* const> force_device_kinds() noexcept {
    return kForceDevices;
}

DeviceFacts number_facts(DeviceSettings& settings) {
    DeviceFacts facts;
    for (const DeviceRow& row : settings.rows()) {
        if (const double* const* number = std::get_if<double*>(&row.value))
            facts.emplace_back(row.name, number_text(**number));
    }
    return facts;
}

}  // namespace dibhr
