// Rows and icons that all panels are made of.
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "app/viewer_state.hpp"

namespace dibhr {

/// A collapsible section; `open` is kept by the caller.
bool section(const ViewerState& state, const char* title, bool& open);

/// How a number is shown, moved and put back.
struct NumberRow {
    const char* label;
    const char* format;  ///< printf format of a double, with the unit
    double lowest;
    double highest;   ///< of the slider; a typed number may be higher
    double standard;  ///< what the small arrow puts back
    const char* help{""};
};

/// Label, slider, and a small arrow when the value is not the standard one. True when it changed.
bool number_row(const NumberRow& row, double& value);

/// Label and tick box, and the arrow. True when it changed.
bool flag_row(const char* label, bool& value, bool standard, const char* help);

/// Label, a list to choose from, and an arrow back to its first entry. True when the choice
/// changed.
bool choice_row(const char* label, std::span<const char* const> names, int& chosen,
                const char* help);

/// A name and a value to read.
void fact_row(const char* label, const std::string& value);

/// The tooltip of the last item.
void explain(const char* text);

/// Text that breaks at the panel's edge, in the quiet colour.
void quiet_text(const std::string& text);

enum class Icon { play, pause, step_back, step_forward, loop, put_back };

/// A square button with a drawn icon and a tooltip; a lit one says that what it stands for is on.
bool icon_button(const char* id, Icon icon, const char* help, bool lit = false);

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "01:23.456"
std::string clock_text(double seconds);

}  // namespace dibhr
