// What people choose about their Falcon, and what they are told of it: its stage, and one plain
// sentence with the next step.
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

/// Chosen before the port is opened.
struct ConnectionOptions {
    std::string serial{};        ///< empty: the first one, in the order of their serials
    bool event_character{true};  ///< the chip flushes on '>' (untried on a real unit)
    bool slower_upload{false};   ///< 140 351 instead of 142 857 baud; both are reported to work
};

/// Changed while touching, handed whole to the next tick.
struct Tuning {
    Geometry geometry{};
    Motors motors{};
    WorkspaceOptions workspace{};
    std::uint8_t clutch_buttons{static_cast<std::uint8_t>(Button::centre)};    ///< bits of Button
    std::uint8_t force_off_buttons{static_cast<std::uint8_t>(Button::minus)};  ///< bits of Button
    std::uint32_t centred{0};  ///< a new value forgets the clutch's shift

    bool operator==(const Tuning&) const = default;
    /// With these the same pose gives the same goal, and the same force the same commands.
    [[nodiscard]] auto felt() const noexcept {
        return std::tie(geometry, motors, workspace, centred);
    }
};

/// How far it has come. A fault leads back to `looking` with the reason in Status::sentence.
enum class Stage {
    looking,      ///< none attached, or the last one is gone
    cannot_open,  ///< attached, but refused: permission, another driver or program
    no_firmware,  ///< nothing answers and there is no file to load
    loading,      ///< the firmware goes in
    homing,       ///< answers; not all axes are homed
    ready         ///< poses and forces
};

/// The buttons are plus, forward, centre, minus.
struct Status : DeviceStatus {
    Stage stage{Stage::looking};
    std::string serial{};  ///< empty: not known
    double loaded{0.0};    ///< part of the firmware that is in, 0 .. 1
    int load_try{0};       ///< 1 ..
    Reply reply{};         ///< the last one, buttons debounced
    double replies_per_s{0.0};
    std::uint64_t replies{0};
    std::uint64_t resent{0};           ///< commands sent again for want of a reply
    std::uint64_t bytes_discarded{0};  ///< that belonged to no reply
    std::uint64_t line_errors{0};      ///< packets with overrun, parity or framing bits
};

/// The USB thread writes it, the window reads it.
using StatusBoard = StateBoard<Status>;

}  // namespace dibhr::falcon
