// What of the time between two frames is to be found out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/haptics/words.hpp"

namespace dibhr {

/// Whether what moves does so between two frames, too, instead of fading.
enum class InBetweens : std::uint8_t {
    automatic,  ///< where it carries what touches it: under a hand that goes along nothing fades
    on,
    off,
};

inline constexpr std::array<Word<InBetweens>, 3> kInBetweensWords{
    {{InBetweens::automatic, "auto", "With Carried along"},
     {InBetweens::on, "on", "On"},
     {InBetweens::off, "off", "Off"}}};
static_assert(has_all_in_order(kInBetweensWords, InBetweens::off));

[[nodiscard]] constexpr const auto& words_of(InBetweens) noexcept {
    return kInBetweensWords;
}

struct MotionWanted {
    bool motion{false};       ///< where each pixel goes, by which a proxy is carried
    bool in_betweens{false};  ///< what moves is on its way between frames; finds the motion, too

    [[nodiscard]] bool any() const noexcept { return motion || in_betweens; }
    bool operator==(const MotionWanted&) const = default;
};

[[nodiscard]] constexpr MotionWanted motion_wanted(bool carry, InBetweens in_betweens) noexcept {
    const bool as_carry = in_betweens == InBetweens::automatic && carry;
    return {.motion = carry, .in_betweens = as_carry || in_betweens == InBetweens::on};
}

}  // namespace dibhr
