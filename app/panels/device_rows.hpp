// Rows of the Device panel that every force device has: its numbers and its grip's buttons.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "app/panels/widgets.hpp"
#include "app/settings/device_number.hpp"
#include "app/settings/grip_buttons.hpp"

namespace dibhr {

template <typename Settings, typename Topic>
void draw_device_number(const DeviceNumber<Settings, Topic>& number, Settings& settings) {
    Settings standard;
    double shown = number.in(settings)*number.shown;
    const NumberRow row{
        .label = number.label,
        .format = number.format,
        .lowest = number.lowest * number.shown,
        .highest = number.highest * number.shown,
        .standard = number.in(standard)*number.shown,
        .help = number.help,
        .logarithmic = number.lowest > 0.0 && number.highest > 50.0 * number.lowest};
    if (number_row(row, shown)) {
        number.in(settings) = std::clamp(shown / number.shown, number.lowest, number.highest);
    }
}

/// Those of `topic`.
template <typename Settings, typename Topic>
void draw_device_numbers(std::span<const DeviceNumber<Settings, Topic>> numbers, Topic topic,
                         Settings& settings) {
    for (const DeviceNumber<Settings, Topic>& number : numbers) {
        if (number.topic == topic) draw_device_number(number, settings);
    }
}

inline void draw_grip_buttons(const GripButtons& grip, ButtonActions& buttons) {
    for (std::size_t k = 0; k < buttons.size(); ++k) {
        choice_row(grip[k].label, button_jobs(), buttons[k], "What this button of the grip does",
                   grip[k].standard);
    }
}

}  // namespace dibhr
