// The device named on the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "device/force_devices.hpp"
#include "device/mouse_hand.hpp"

namespace dibhr {

/// How devices are to be found and started.
struct DeviceChoice {
    AllDeviceSettings settings{};
    std::filesystem::path firmware{};  ///< --firmware; empty: the kept one
};

/// What touches, and its ends for the window thread.
struct HandDevice {
    std::unique_ptr<Device> device{};
    MouseHand* mouse{nullptr};  ///< it, or what stands in for it; null: no mouse
    /// Parts of it, in the order of force_device_kinds(), null where none is looked for; empty: no
    /// force device is.
    std::vector<ForceDevice*> devices{};

    /// A force device is looked for, and the mouse is only what stands in.
    [[nodiscard]] bool looks_for_device() const noexcept { return !devices.empty(); }
};

/// `auto`, `mouse`, a kind, one of a kind (`falcon:SERIAL`, `inverse3:ID`, also `left` and `right`)
/// or `goals:FILE`. With `auto` the mouse touches until a force device is there; with a kind one
/// has to be attached and to open, or its service to have one. Throws DeviceError for a device that
/// cannot be used, InputError for a goal stream or firmware that cannot be read.
[[nodiscard]] HandDevice make_hand_device(const std::string& name, const DeviceChoice& choice = {});

/// Whether make_hand_device() knows what is meant by it.
[[nodiscard]] bool names_device(const std::string& name);
/// Whether that moves a hand: all but the mouse and goals.
[[nodiscard]] bool moves_hand(const std::string& name);
/// What it knows, for people: "auto, falcon, ... or goals:FILE"; `of_auto` follows the first word.
[[nodiscard]] std::string device_names(const std::string& of_auto = {});
/// " (a Falcon or an Inverse3, and the mouse until one is there)".
[[nodiscard]] std::string meaning_of_auto();

}  // namespace dibhr
