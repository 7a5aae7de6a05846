// All kinds of force devices: CMakeLists.txt of this folder lists them.
#pragma once

#include <span>
#include <string>

#include "device/force_device.hpp"

namespace dibhr {

/// In the order in which `auto` prefers them. HandReading::which is a kind's place, from 1: a new
/// one comes last.
[[nodiscard]] std::span<const ForceDeviceKind* const> force_device_kinds() noexcept;

/// The numbers of the settings, as a session keeps them: "thigh", "0.06".
[[nodiscard]] DeviceFacts number_facts(DeviceSettings& settings);

}  // namespace dibhr
