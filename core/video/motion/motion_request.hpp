// Which of motion and in-betweens are computed between two frames.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/haptics/enum_names.hpp"

namespace dibhr {

/// Whether moving parts also move between two frames, instead of fading.
enum class InBetweens : std::uint8_t {
    automatic,  ///< on with carry: under a hand that is carried along nothing fades
    on,
    off,
};

inline constexpr std::array<NamedValue<InBetweens>, 3> kInBetweensNames{
    {{InBetweens::automatic, "auto", "With Carried along"},
     {InBetweens::on, "on", "On"},
     {InBetweens::off, "off", "Off"}}};
static_assert(has_all_in_order(kInBetweensNames, InBetweens::off));

[[nodiscard]] constexpr const auto& name_table(InBetweens) noexcept {
    return kInBetweensNames;
}

struct MotionRequest {
    bool motion{false};       ///< where each pixel moves, by which a proxy is carried
    bool in_betweens{false};  ///< frames between frames; needs and finds the motion, too

    [[nodiscard]] bool any() const noexcept { return motion || in_betweens; }
    bool operator==(const MotionRequest&) const = default;
};

[[nodiscard]] constexpr MotionRequest motion_request(bool carry, InBetweens in_betweens) noexcept {
    const bool as_carry = in_betweens == InBetweens::automatic && carry;
    return {.motion = carry, .in_betweens = as_carry || in_betweens == InBetweens::on};
}

}  // namespace dibhr
