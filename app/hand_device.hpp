// The device named on the command line.
#pragma once

#include <memory>
#include <string>

#include "device/device.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// What touches, and its mouse end when it is the mouse.
struct HandDevice {
    std::unique_ptr<Device> device{};
    MouseHand* mouse{nullptr};  ///< the same device, or null
};

/// `auto`, `mouse`, `falcon` or `goals:FILE`. Throws DeviceError for one that cannot be used,
/// InputError for a goal stream that cannot be read.
[[nodiscard]] HandDevice make_hand_device(const std::string& name);

}  // namespace dibhr
