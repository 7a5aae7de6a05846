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

std::vector<std::string> force_device_names() {
    std::vector<std::string> names;
    for (const ForceDeviceKind* const kind : kForceDevices) names.emplace_back(kind->name);
    return names;
}

AllDeviceSettings::AllDeviceSettings() {
    for (const ForceDeviceKind* const kind : kForceDevices) all_.push_back(kind->make_settings());
}

AllDeviceSettings::AllDeviceSettings(const AllDeviceSettings& other) {
    for (const auto& settings : other.all_) all_.push_back(settings->clone());
}

AllDeviceSettings& AllDeviceSettings::operator=(const AllDeviceSettings& other) {
    AllDeviceSettings copy(other);
    all_.swap(copy.all_);
    return *this;
}

DeviceFacts number_facts(const DeviceSettings& settings) {
    DeviceFacts facts;
    const auto copy = settings.clone();
    for (const DeviceRow& row : copy->rows()) {
        if (const double* const* number = std::get_if<double*>(&row.value))
            facts.emplace_back(row.name, number_text(**number));
    }
    return facts;
}

}  // namespace dibhr
