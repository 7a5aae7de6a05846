// The device named on the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/loop/device.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/falcon/status.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// How a Falcon is to be found and started.
struct FalconChoice {
    falcon::ConnectionOptions connection{};
    std::filesystem::path firmware{};  ///< --firmware; empty: the kept one
};

/// What touches, and its ends for the window thread.
struct HandDevice {
    std::unique_ptr<Device> device{};
    MouseHand* mouse{nullptr};              ///< it, or what stands in for it; null: no mouse
    falcon::FalconDevice* falcon{nullptr};  ///< it, or a part of it; null: no Falcon is looked for
    std::string firmware{};                 ///< name of what is loaded when the Falcon needs it
    std::string firmware_trouble{};         ///< why the kept firmware cannot be used
};

/// `auto`, `mouse`, `falcon`, `falcon:SERIAL` or `goals:FILE`. With `auto` the mouse touches until
/// a Falcon is there; with `falcon` one has to be attached and to open. Throws DeviceError for a
/// device that cannot be used, InputError for a goal stream or firmware that cannot be read.
[[nodiscard]] HandDevice make_hand_device(const std::string& name, const FalconChoice& choice = {});

/// Firmware for a Falcon that has none.
struct FirmwareAtHand {
    falcon::FirmwareImage image{};
    std::string trouble{};  ///< why the kept file cannot be used
};

/// `given`, checked and kept for the next time, or the kept one. Throws InputError when `given` is
/// no firmware.
[[nodiscard]] FirmwareAtHand firmware_at_hand(const std::filesystem::path& given);

}  // namespace dibhr
