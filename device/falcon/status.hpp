// Options and tuning of a Falcon, and its status: the stage, and one plain sentence with the next
// step.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "device/falcon/kinematics.hpp"
#include "device/falcon/packet.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/state_board.hpp"
#include "device/hand/workspace.hpp"

namespace dibhr::falcon {

/// Set before the port is opened.
struct ConnectionOptions {
    std::string serial{};        ///< empty: the first one, in the order of their serials
    bool event_character{true};  ///< the chip flushes on '>' (untried on a real unit)
    bool slower_upload{false};   ///< 140 351 instead of 142 857 baud; both are reported to work
};

/// May change while touching; the next tick takes it as a whole.
struct Tuning {
    Geometry geometry{};
    Motors motors{};
    WorkspaceOptions workspace{};
    std::uint8_t clutch_buttons{static_cast<std::uint8_t>(Button::centre)};    ///< bits of Button
    std::uint8_t force_off_buttons{static_cast<std::uint8_t>(Button::minus)};  ///< bits of Button
    std::uint32_t centre_count{0};  ///< a new value resets the clutch's shift

    bool operator==(const Tuning&) const = default;
    /// The values that change the goal of a pose, or the commands of a force.
    [[nodiscard]] auto rendered_values() const noexcept {
        return std::tie(geometry, motors, workspace, centre_count);
    }
};

/// After a failure the stage is `looking` again, with the reason in Status::sentence.
enum class Stage {
    looking,      ///< none is attached, or the last one was lost
    cannot_open,  ///< attached, but opening failed: permission, another driver or program
    no_firmware,  ///< the Falcon does not answer and there is no file to load
    loading,      ///< the firmware is being loaded
    homing,       ///< the Falcon answers; not all axes are homed
    ready         ///< poses and forces
};

/// The buttons are plus, forward, centre, minus.
struct Status : DeviceStatus {
    Stage stage{Stage::looking};
    std::string serial{};  ///< empty: not known
    double loaded{0.0};    ///< loaded part of the firmware, 0 .. 1
    int load_try{0};       ///< number of the try, from 1
    Reply reply{};         ///< the last one, buttons debounced
    double replies_per_s{0.0};
    std::uint64_t replies{0};
    std::uint64_t resent{0};           ///< commands sent again because no reply came
    std::uint64_t bytes_discarded{0};  ///< that belonged to no reply
    std::uint64_t line_errors{0};      ///< packets with overrun, parity or framing bits
};

/// Written by the USB thread, read by the window.
using StatusBoard = StateBoard<Status>;

}  // namespace dibhr::falcon
