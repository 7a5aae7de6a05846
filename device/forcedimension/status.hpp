// Options and tuning of a Force Dimension arm, and its status: the stage, and one plain sentence
// with the next step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>

#include "device/arm_exchanges.hpp"
#include "device/force_device.hpp"
#include "device/forcedimension/library.hpp"
#include "device/hand/state_board.hpp"
#include "device/hand/usb_list.hpp"
#include "device/hand/workspace.hpp"

namespace dibhr::forcedimension {

/// Set before the search begins.
struct ConnectionOptions {
    std::string serial{};   ///< empty: the first arm that can be opened
    std::string library{};  ///< a file, a folder or a record; empty: wherever it is installed
    std::filesystem::path usb_devices{kUsbDevices};
};

/// May change while touching; the next tick takes it as a whole.
struct Tuning {
    /// centre_z_mm is 0, because `centre_mm` is subtracted; there is no soft boundary.
    WorkspaceOptions workspace{.centre_z_mm = 0.0, .boundary_newton_per_mm = 0.0};
    Vec3 centre_mm{0.0};  ///< of the workspace, the hand's axes
    double max_force_newton{4.0};
    std::uint8_t clutch_buttons{0};
    std::uint8_t force_off_buttons{0};
    std::uint32_t centre_count{0};  ///< a new value resets the clutch's shift

    bool operator==(const Tuning&) const = default;
    /// The values that change the goal of a pose.
    [[nodiscard]] auto rendered_values() const noexcept {
        return std::tie(workspace, centre_mm, centre_count);
    }
    // As of an ArmDevice.
    [[nodiscard]] Vec3 hand_mm(Vec3 position_m) const noexcept;
    [[nodiscard]] Vec3 arm_newton(Vec3 hand_newton) const noexcept;
    [[nodiscard]] static double delay_s(int exchange_ms) noexcept;
};

/// After a loss the stage is `looking` again, with the reason in Status::sentence.
enum class Stage {
    looking,          ///< no arm is attached, or the connection was lost
    no_permission,    ///< an arm is attached, and this user may not open it
    cannot_open,      ///< in use by another program, or another failure
    no_power,         ///< the controller has no power
    not_initialised,  ///< its position means nothing yet
    initialising,     ///< the arm drives itself to its stops
    fault,            ///< the controller reports an error, or answers nothing that can be used
    force_off,        ///< the arm has switched its force off
    slow,             ///< calls take too long for a force
    ready             ///< poses and forces
};

struct Status : DeviceStatus, ExchangeStatus {
    Stage stage{Stage::looking};
    std::string library{};  ///< file, and version
    std::string serial{};   ///< empty: not known
    int type{-1};           ///< -1: no arm is open
    std::optional<double> controller_version{};
    double watchdog_ms{0.0};  ///< of the firmware; 0: it has none
    bool clamped{false};      ///< the library limits the force, too
    ForceOff cause{ForceOff::none};
    std::optional<DeviceOffer> offer{};
    std::uint64_t failed_calls{0};
};

/// Written by the device's thread, read by the window.
using Board = StateBoard<Status>;

/// "the omega.3 1234", "the Force Dimension arm".
[[nodiscard]] std::string name_of(const Status& status);

/// The sentence for the user: the state and the next step.
[[nodiscard]] std::string sentence_for(Stage stage, const Status& status);

}  // namespace dibhr::forcedimension
