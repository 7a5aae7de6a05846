// All kinds of force devices: CMakeLists.txt of this folder lists them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "device/force_device.hpp"

namespace dibhr {

/// In the order in which `auto` prefers them. HandReading::which is the index of a kind, from 1: a
/// new kind is added at the end.
[[nodiscard]] std::span<const ForceDeviceKind* const> force_device_kinds() noexcept;

/// The names of the kinds, in that order.
[[nodiscard]] std::vector<std::string> force_device_names();

/// The settings of all kinds, in that order. A copy has values of its own.
class AllDeviceSettings {
  public:
    /// The defaults.
    AllDeviceSettings();
    AllDeviceSettings(const AllDeviceSettings& other);
    AllDeviceSettings& operator=(const AllDeviceSettings& other);
    ~AllDeviceSettings() = default;

    [[nodiscard]] std::size_t size() const noexcept { return all_.size(); }
    [[nodiscard]] DeviceSettings& operator[](std::size_t kind) noexcept { return *all_[kind]; }
    [[nodiscard]] const DeviceSettings& operator[](std::size_t kind) const noexcept {
        return *all_[kind];
    }

  private:
    std::vector<std::unique_ptr<DeviceSettings>> all_{};
};

/// The numbers of the settings, as a session keeps them: "thigh", "0.06".
[[nodiscard]] DeviceFacts number_facts(const DeviceSettings& settings);

}  // namespace dibhr
