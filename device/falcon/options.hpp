// What people choose about their Falcon.
#pragma once

#include <cstdint>
#include <string>

#include "device/falcon/kinematics.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/workspace.hpp"

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
};

}  // namespace dibhr::falcon
