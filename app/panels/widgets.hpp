// Rows and icons that all panels are made of.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"

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
    bool logarithmic{false};
    const char* zero{nullptr};  ///< shown for 0 instead of the number
};

/// Label, slider, and a small arrow when the value is not the standard one. True when it changed.
bool number_row(const NumberRow& row, double& value);

/// Label and tick box, and the arrow. True when it changed.
bool flag_row(const char* label, bool& value, bool standard, const char* help);

/// Label, a list to choose from, and an arrow back to the `standard` entry. True when the choice
/// changed.
bool index_row(const char* label, std::span<const char* const> names, int& chosen, const char* help,
               int standard);

/// The same for an enumeration, from its table of words, which has_all_in_order().
template <typename Table, typename Enum>
bool choice_row(const char* label, const Table& words, Enum& chosen, const char* help,
                Enum standard = {}) {
    std::vector<const char*> names;
    for (const auto& word : words) names.push_back(word.label);
    int index = static_cast<int>(chosen);
    const bool changed = index_row(label, names, index, help, static_cast<int>(standard));
    chosen = static_cast<Enum>(index);
    return changed;
}

/// The bar below the relief, as wide as it; to be ended with ImGui::End().
void begin_bottom_bar(const ViewerState& state, const char* name);

/// A name and a value to read.
void fact_row(const char* label, const std::string& value);

/// The tooltip of the last item.
void explain(const char* text);

/// Text that breaks at the panel's edge, in the quiet colour.
void quiet_text(const std::string& text);

/// The same in the colour of trouble, behind a warning sign.
void trouble_text(const std::string& text);

/// A collapsible part of a section; true when it is open. Its rows are not indented.
bool part(const char* title);

enum class Icon { play, pause, step_back, step_forward, loop, put_back };

/// A square button with a drawn icon and a tooltip; a lit one says that what it stands for is on.
bool icon_button(const char* id, Icon icon, const char* help, bool lit = false);

/// A line for stderr as a sentence for the window: with a capital letter.
std::string capitalised(std::string line);

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "2026-05-31T12:00:00Z" as "2026-05-31 12:00 UTC"; another text as it is.
std::string date_text(const std::string& utc);

/// "01:23.456"
std::string clock_text(double seconds);

}  // namespace dibhr
