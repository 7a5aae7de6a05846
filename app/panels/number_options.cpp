// Sliders made from the table of touch parameters.
#include "app/panels/number_options.hpp"

#include <algorithm>
#include <string>

#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

/// The slider ends where people work; a typed number may go on to the option's own end.
double slider_end(const TouchNumber& option, double standard) {
    return std::min(option.highest, standard > 0.0 ? 4.0 * standard : option.highest / 4.0);
}

std::string format_of(const TouchNumber& option, double end) {
    const char* digits = end >= 200.0  ? "%.0f"
                         : end >= 10.0 ? "%.1f"
                         : end >= 1.0  ? "%.2f"
                                       : "%.3f";
    return option.unit.empty() ? digits : std::string(digits) + " " + std::string(option.unit);
}

void draw_number(const TouchNumber& option, TouchParameters& parameters) {
    const double standard = option.standard();
    const double end = slider_end(option, standard);
    const std::string label(option.label);
    const std::string format = format_of(option, end);
    const std::string help = std::string(option.help) + " (--" + std::string(option.name) + ")";
    if (number_row({.label = label.c_str(),
                    .format = format.c_str(),
                    .lowest = option.lowest,
                    .highest = end,
                    .standard = standard,
                    .help = help.c_str(),
                    .zero = option.zero},
                   option.in(parameters))) {
        keep_in_range(parameters);
    }
}

}  // namespace

void draw_numbers(TouchTopic topic, TouchParameters& parameters) {
    for (const TouchNumber& option : touch_numbers()) {
        if (option.topic == topic) draw_number(option, parameters);
    }
}

}  // namespace dibhr
