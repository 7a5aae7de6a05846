// The device named on the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/loop/device.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/falcon/status.hpp"
#include "device/inverse3/inverse3_device.hpp"
#include "device/inverse3/status.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// How a Falcon is to be found and started.
struct FalconChoice {
    falcon::ConnectionOptions connection{};
    std::filesystem::path firmware{};  ///< --firmware; empty: the kept one
};

/// How devices are to be found.
struct DeviceChoice {
    FalconChoice falcon{};
    inverse3::ConnectionOptions inverse3{};
};

/// What touches, and its ends for the window thread.
struct HandDevice {
    std::unique_ptr<Device> device{};
    MouseHand* mouse{nullptr};              ///< it, or what stands in for it; null: no mouse
    falcon::FalconDevice* falcon{nullptr};  ///< it, or a part of it; null: no Falcon is looked for
    inverse3::Inverse3Device* inverse3{nullptr};  ///< likewise
    std::string firmware{};          ///< name of what is loaded when the Falcon needs it
    std::string firmware_trouble{};  ///< why the kept firmware cannot be used

    /// A force device is looked for, and the mouse is only what stands in.
    [[nodiscard]] bool looks_for_device() const noexcept {
        return falcon != nullptr || inverse3 != nullptr;
    }
};

/// `auto`, `mouse`, `falcon`, `falcon:SERIAL`, `inverse3`, `inverse3:ID` (also `left` and `right`)
/// or `goals:FILE`. With `auto` the mouse touches until a Falcon or an Inverse3 is there; with
/// `falcon` one has to be attached and to open, with `inverse3` the service has to have one. Throws
/// DeviceError for a device that cannot be used, InputError for a goal stream or firmware that
/// cannot be read.
[[nodiscard]] HandDevice make_hand_device(const std::string& name, const DeviceChoice& choice = {});

/// Whether make_hand_device() knows what is meant by it.
[[nodiscard]] bool names_device(const std::string& name);
/// Whether that moves a hand: all but the mouse and goals.
[[nodiscard]] bool moves_hand(const std::string& name);
/// What it knows, for who has named another: "auto, mouse, falcon, ...".
inline constexpr const char* kDeviceNames =
    "auto, falcon, falcon:SERIAL, inverse3, inverse3:ID, mouse or goals:FILE";

/// Firmware for a Falcon that has none.
struct FirmwareAtHand {
    falcon::FirmwareImage image{};
    std::string trouble{};  ///< why the kept file cannot be used
};

/// `given`, checked and kept for the next time, or the kept one. Throws InputError when `given` is
/// no firmware.
[[nodiscard]] FirmwareAtHand firmware_at_hand(const std::filesystem::path& given);

}  // namespace dibhr
