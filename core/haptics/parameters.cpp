// The names of the proxy algorithms, and the table of what people tune.
#include "core/haptics/parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace dibhr {

namespace {

constexpr std::array<NamedValue<Algorithm>, 4> kAlgorithmNames{{
    {Algorithm::dibhr, "dibhr", "DIBHR"},
    {Algorithm::pga, "pga", "PGA (proxy graph)"},
    {Algorithm::neighborhood, "neighborhood", "Neighborhood"},
    {Algorithm::god_object, "god-object", "God-object"},
}};
static_assert(has_all_in_order(kAlgorithmNames, Algorithm::god_object));

constexpr auto kAlgorithms = [] {
    std::array<Algorithm, kAlgorithmNames.size()> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = kAlgorithmNames[k].value;
    return all;
}();

using P = TouchParameters;

// The highest stiffness pulls with a little more than a Falcon's 8 N at a millimetre of
// penetration; the safety stage limits the force for any value.
constexpr std::array kTouchNumbers{
    TouchNumber{"relief", "Relief", "relief_px", "px", TouchTopic::shape, 0.0, 4096.0,
                "Elevation of the nearest depth; 255: one grey level is one pixel high",
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
                0.0, 10.0, "Force of the spring per millimetre from goal to proxy",
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

constexpr std::array kTouchSwitches{
    TouchSwitch{"carry", "Carried along", "carry", TouchTopic::friction,
                "What moves in the video carries the finger along: friction and damping follow the "
                "difference of the two speeds",
                [](P& p) -> bool& { return p.carry; }, true},
};

constexpr std::array kTouchChoices{
    TouchChoice{"algorithm", "Algorithm", "algorithm", "an algorithm", TouchTopic::algorithm,
                "How the proxy follows the goal",
                [](P& p) -> TouchChoiceTarget { return &p.algorithm; }, true},
};

constexpr bool is_plain(const TouchSwitch& entry) {
    return !entry.needs_motion;
}

constexpr std::size_t kPlainSwitches =
    static_cast<std::size_t>(std::count_if(kTouchSwitches.begin(), kTouchSwitches.end(), is_plain));

constexpr auto kPlainNumbers = [] {
    std::array<PlainNumber, kTouchNumbers.size() + kPlainSwitches> all{};
    std::size_t count = 0;
    for (const TouchNumber& number : kTouchNumbers) {
        all[count++] = {number.name,   number.label,   number.unit, number.help,
                        number.lowest, number.highest, &number,     nullptr};
    }
    for (const TouchSwitch& entry : kTouchSwitches) {
        if (is_plain(entry))
            all[count++] = {entry.name, entry.label, "", entry.help, 0.0, 1.0, nullptr, &entry};
    }
    return all;
}();

}  // namespace

std::span<const Algorithm> all_algorithms() noexcept {
    return kAlgorithms;
}

std::span<const NamedValue<Algorithm>> name_table(Algorithm) noexcept {
    return kAlgorithmNames;
}

const char* name_of(Algorithm algorithm) noexcept {
    return entry_of(kAlgorithmNames, algorithm).name;
}

std::string_view TouchChoice::of(TouchParameters parameters) const {
    return std::visit([](const auto* value) { return std::string_view(name_of(*value)); },
                      in(parameters));
}

bool TouchChoice::choose(std::string_view word, TouchParameters& parameters) const {
    return std::visit(
        [word](auto* value) {
            const auto chosen = named<std::remove_pointer_t<decltype(value)>>(word);
            if (chosen) *value = *chosen;
            return chosen.has_value();
        },
        in(parameters));
}

std::vector<std::string> TouchChoice::names() const {
    TouchParameters any;
    return std::visit(
        [](auto* value) { return all_names<std::remove_pointer_t<decltype(value)>>(); }, in(any));
}

std::span<const TouchNumber> touch_numbers() noexcept {
    return kTouchNumbers;
}

std::span<const TouchSwitch> touch_switches() noexcept {
    return kTouchSwitches;
}

std::span<const TouchChoice> touch_choices() noexcept {
    return kTouchChoices;
}

double PlainNumber::of(const TouchParameters& parameters) const {
    if (number != nullptr) return number->of(parameters);
    return on_off->of(parameters) ? 1.0 : 0.0;
}

void PlainNumber::put(double value, TouchParameters& parameters) const {
    if (number != nullptr)
        number->in(parameters) = value;
    else
        on_off->in(parameters) = value != 0.0;
}

std::span<const PlainNumber> plain_numbers() noexcept {
    return kPlainNumbers;
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
