// The system's list of USB devices: to a maker's library, a device without permission is no device.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dibhr {

inline constexpr const char* kUsbDevices = "/sys/bus/usb/devices";

struct UsbDevice {
    std::string maker{};  ///< as the list has it: "1451"
    std::string product{};
    std::string node{};  ///< its file: "/dev/bus/usb/001/004"

    /// This user may read and write it.
    [[nodiscard]] bool may_open() const;
};

/// `devices`: the system's list. A list that cannot be read is empty.
[[nodiscard]] std::vector<UsbDevice> listed_usb_devices(const std::filesystem::path& devices);

}  // namespace dibhr
