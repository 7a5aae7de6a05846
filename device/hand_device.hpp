// The device named on the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "device/force_devices.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// What a start of the program chooses: settings of all devices, and a firmware file.
struct DeviceChoice {
    AllDeviceSettings settings{};
    std::filesystem::path firmware{};  ///< --firmware; empty: the kept file
};

/// The device of the haptic loop, and pointers to its parts for the window thread.
struct HandDevice {
    std::unique_ptr<Device> device{};
    MouseHand* mouse{nullptr};  ///< `device` itself, or its fallback; null: no mouse
    /// Parts of `device`, in the order of force_device_kinds(), null where that kind is not
    /// searched for; empty: no kind is.
    std::vector<ForceDevice*> devices{};

    /// A force device is searched for, and the mouse is only the fallback.
    [[nodiscard]] bool looks_for_device() const noexcept { return !devices.empty(); }
};

/// `auto`, `mouse`, a kind, one of a kind (`falcon:SERIAL`, `inverse3:ID`, also `left` and `right`)
/// or `goals:FILE`. With `auto` the mouse touches until a force device is ready. With a kind, a
/// device must be attached and open, or its service must have one. Throws DeviceError for a device
/// that cannot be used, InputError for a goal stream or firmware that cannot be read.
[[nodiscard]] HandDevice make_hand_device(const std::string& name, const DeviceChoice& choice = {});

/// Whether make_hand_device() accepts this name.
[[nodiscard]] bool names_device(const std::string& name);
/// Whether this device can move a hand: all but the mouse and goals.
[[nodiscard]] bool moves_hand(const std::string& name);
/// All names, for the user: "auto, falcon, ... or goals:FILE"; `of_auto` is put behind "auto".
[[nodiscard]] std::string device_names(const std::string& of_auto = {});
/// " (a Falcon or an Inverse3, and the mouse until one is there)".
[[nodiscard]] std::string meaning_of_auto();

}  // namespace dibhr
