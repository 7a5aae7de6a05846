// What the system says of devices on the USB: the library itself reports a device without
// permission as no device.
#pragma once

#include <filesystem>
#include <string>

namespace dibhr::forcedimension {

struct UsbBus {
    bool has_arm{false};         ///< a device of Force Dimension is attached
    std::string refused_node{};  ///< the file of an arm that this user may not open; empty: none
    bool has_falcon{false};      ///< a Novint Falcon is attached
};

/// `devices`: the system's list. A list that cannot be read is empty.
[[nodiscard]] UsbBus read_usb_bus(const std::filesystem::path& devices = "/sys/bus/usb/devices");

}  // namespace dibhr::forcedimension
