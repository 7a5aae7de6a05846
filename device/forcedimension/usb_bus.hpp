// What the system says of devices on the USB.
#pragma once

#include <filesystem>
#include <string>

#include "device/hand/usb_list.hpp"

namespace dibhr::forcedimension {

struct UsbBus {
    bool has_arm{false};         ///< a device of Force Dimension is attached
    std::string refused_node{};  ///< the file of an arm that this user may not open; empty: none
    bool has_falcon{false};      ///< a Novint Falcon is attached
};

[[nodiscard]] UsbBus read_usb_bus(const std::filesystem::path& devices = kUsbDevices);

}  // namespace dibhr::forcedimension
