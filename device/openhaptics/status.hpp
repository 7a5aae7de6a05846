// Options and tuning of a Touch, and its status: the stage, and one plain sentence with the next
// step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <tuple>

#include "core/haptics/vec.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/state_board.hpp"
#include "device/hand/usb_list.hpp"
#include "device/hand/workspace.hpp"
#include "device/openhaptics/hd.hpp"

namespace dibhr::openhaptics {

/// Set before the library is loaded.
struct ConnectionOptions {
    std::string name{};     ///< of the device's configuration; empty: the default one
    std::string library{};  ///< a file, a folder or a record; empty: where it is installed
    bool forces{true};      ///< false: the motors stay off, as for a survey
    /// Makes the functions that are called in place of the library's; null: its own are.
    std::function<HdLibrary(const HdLibrary&)> around{};
    std::filesystem::path usb_devices{kUsbDevices};
};

/// May change while touching; the next tick takes it as a whole.
struct Tuning {
    /// centre_z_mm is 0, because poses are relative to the middle of the usable workspace; there is
    /// no soft boundary. Radius: of the Touch, README.md, Numbers.
    WorkspaceOptions workspace{
        .centre_z_mm = 0.0, .radius_mm = 75.0, .boundary_newton_per_mm = 0.0};
    double max_force_newton{4.0};
    std::uint8_t clutch_buttons{0};
    std::uint8_t force_off_buttons{0};
    std::uint32_t centre_count{0};  ///< a new value resets the clutch's shift

    bool operator==(const Tuning&) const = default;
    /// The values that change the goal of a pose.
    [[nodiscard]] auto rendered_values() const noexcept {
        return std::tie(workspace, centre_count);
    }
    // As of an ArmDevice; the arm's axes are those of the hand.
    [[nodiscard]] Vec3 hand_mm(Vec3 position_m) const noexcept { return 1000.0 * position_m; }
    [[nodiscard]] Vec3 arm_newton(Vec3 hand_newton) const noexcept { return hand_newton; }
    /// `tick_ms`: of the servo thread, rounded up: 2 at 1 kHz, where the delay is the nominal one.
    [[nodiscard]] static double delay_s(int tick_ms) noexcept { return 1.5e-3 * tick_ms; }
};

/// After a failure the stage is `looking` again, with the reason in Status::sentence.
enum class Stage : std::uint8_t {
    opening,         ///< the library is being loaded, or the device opened
    no_library,      ///< OpenHaptics is not installed
    broken_library,  ///< it is, but cannot be loaded
    cannot_open,     ///< in use by another program, or without a licence
    looking,         ///< no device answers, or the last one was lost
    starting,        ///< the first poses of a link
    not_calibrated,
    stands_still,    ///< the arm's encoders stand still while the stylus turns
    not_understood,  ///< poses that no arm can have
    force_cut,       ///< the library reports that the device cut the force
    refused,         ///< the library refused a call
    hot,             ///< the motors are too warm for any force
    silent,          ///< the library calls dibhr no longer
    ready            ///< poses and forces
};

struct Status : DeviceStatus {
    Stage stage{Stage::opening};
    std::string library{};  ///< its file
    std::string version{};  ///< of the library; this and the next ones are empty while not known
    std::string driver{};   ///< version of the device's driver
    std::string model{};
    std::string serial{};
    unsigned int style{0};  ///< of calibration, bits of hd.hpp
    double continuous_newton{0.0};
    double peak_newton{0.0};
    double stiffness_newton_per_mm{0.0};  ///< as the library reports it
    double limit_newton{0.0};             ///< now, with warm motors
    double warmest{0.0};                  ///< temperature of the warmest motor, 0 cold .. 1 hot
    bool reports_heat{true};              ///< the library knows the temperature
    bool warm{false};                     ///< it lowers the limit
    double ticks_per_s{0.0};
    std::uint64_t forces_cut{0};  ///< ticks of this link in which the device cut the force
    std::uint64_t errors{0};      ///< ticks of this link with an error of any kind
    std::string last_error{};     ///< name and number of the last one
};

/// Written by the library's thread of dibhr, read by the window.
using Board = StateBoard<Status>;

/// A Touch is in the system's list of USB devices. One with a network cable never is.
[[nodiscard]] bool is_on_usb(const std::filesystem::path& devices);

/// The sentence for the user: the state and the next step.
[[nodiscard]] std::string sentence_for(Stage stage, const Status& status);

}  // namespace dibhr::openhaptics
