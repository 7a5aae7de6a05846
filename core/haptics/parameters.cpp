// The names of the proxy algorithms, and the table of the numbers people tune.
#include "core/haptics/parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dibhr {

namespace {

constexpr std::array<Word<Algorithm>, 4> kWords{{
    {Algorithm::dibhr, "dibhr", "DIBHR"},
    {Algorithm::pga, "pga", "PGA (proxy graph)"},
    {Algorithm::neighborhood, "neighborhood", "Neighborhood"},
    {Algorithm::god_object, "god-object", "God-object"},
}};
static_assert(has_all_in_order(kWords, Algorithm::god_object));

constexpr auto kAlgorithms = [] {
    std::array<Algorithm, kWords.size()> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = kWords[k].value;
    return all;
}();

using P = TouchParameters;

// The highest stiffness is what a millimetre of penetration may pull with on a Falcon (8 N) and
// then some; the safety stage holds whatever these ask for.
constexpr std::array kTouchNumbers{
    TouchNumber{"relief", "Relief", "relief_px", "px", TouchTopic::shape, 0.0, 4096.0,
                "Elevation of the nearest depth; 255 makes a grey level a pixel",
                [](P& p) -> double& { return p.shape.relief_px; }},
    TouchNumber{"roughness", "Roughness", "roughness_px", "px", TouchTopic::texture, 0.0, 256.0,
                "Elevation of the bump map's highest point",
                [](P& p) -> double& { return p.shape.roughness_px; }},
    TouchNumber{"static-friction", "Static friction", "static_friction", "", TouchTopic::friction,
                0.0, 5.0, "Coefficient while the contact sticks",
                [](P& p) -> double& { return p.friction.static_coefficient; }},
    TouchNumber{"dynamic-friction", "Dynamic friction", "dynamic_friction", "",
                TouchTopic::friction, 0.0, 5.0,
                "Coefficient while it slips, at most the static one",
                [](P& p) -> double& { return p.friction.dynamic_coefficient; }},
    TouchNumber{"stiffness", "Stiffness", "stiffness_newton_per_mm", "N/mm", TouchTopic::spring,
                0.0, 10.0, "Force of the spring from goal to proxy",
                [](P& p) -> double& { return p.coupling.stiffness_newton_per_mm; }},
    TouchNumber{"damping", "Damping", "damping_newton_s_per_m", "N s/m", TouchTopic::damper, 0.0,
                100.0, "Force against the speed of the goal",
                [](P& p) -> double& { return p.coupling.damping_newton_s_per_m; }},
    TouchNumber{"damping-cutoff", "Damping cutoff", "damping_cutoff_hz", "Hz", TouchTopic::damper,
                0.0, 800.0,
                "Low-pass on the speed that is damped, against the buzz of a device's steps: 50 "
                "Hz suits a Falcon; 0: off",
                [](P& p) -> double& { return p.coupling.damping_cutoff_hz; }, "off"},
    TouchNumber{"pixel-pitch", "Pixel pitch", "pixel_pitch_mm", "mm", TouchTopic::shape, 0.001,
                10.0, "Size of a pixel under the hand",
                [](P& p) -> double& { return p.coupling.pixel_pitch_mm; }},
    TouchNumber{"unseen", "Unseen", "unseen_share", "", TouchTopic::shape, 0.0, 1.0,
                "Share of the force where no surface was ever seen; 1: a wall at the back, 0: "
                "nothing is touched there",
                [](P& p) -> double& { return p.coupling.unseen_share; }, "not touched"},
    TouchNumber{"bump-size", "Bump size", "bump_size_px", "px", TouchTopic::texture, 0.0, 4096.0,
                "Width of the bump map, which repeats; 0: stretched over the whole surface once",
                [](P& p) -> double& { return p.shape.bump_size_px; }, "whole surface"},
};

}  // namespace

std::span<const Algorithm> all_algorithms() noexcept {
    return kAlgorithms;
}

std::span<const Word<Algorithm>> algorithm_words() noexcept {
    return kWords;
}

const char* name_of(Algorithm algorithm) noexcept {
    return entry_of(kWords, algorithm).name;
}

std::optional<Algorithm> algorithm_named(std::string_view name) noexcept {
    return value_named(kWords, name);
}

std::span<const TouchNumber> touch_numbers() noexcept {
    return kTouchNumbers;
}

const TouchNumber* touch_number(std::string_view name) noexcept {
    const auto found =
        std::find_if(kTouchNumbers.begin(), kTouchNumbers.end(),
                     [name](const TouchNumber& number) { return number.name == name; });
    return found == kTouchNumbers.end() ? nullptr : &*found;
}

const TouchNumber& number_of(const double& member, TouchParameters& parameters) {
    const auto found =
        std::find_if(kTouchNumbers.begin(), kTouchNumbers.end(),
                     [&](const TouchNumber& number) { return &number.in(parameters) == &member; });
    return found == kTouchNumbers.end() ? kTouchNumbers.front() : *found;
}

void keep_in_range(TouchParameters& parameters) {
    for (const TouchNumber& number : kTouchNumbers) {
        double& value = number.in(parameters);
        if (!std::isfinite(value)) value = number.standard();
        value = std::clamp(value, number.lowest, number.highest);
    }
    Friction& friction = parameters.friction;
    friction.dynamic_coefficient =
        std::min(friction.dynamic_coefficient, friction.static_coefficient);
}

}  // namespace dibhr
