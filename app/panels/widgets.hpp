// Rows and icons for all panels.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "app/panels/icons.hpp"
#include "app/panels/items.hpp"
#include "app/panels/viewer_state.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/playing/transport.hpp"

namespace dibhr {

/// Flags of windows that a person cannot move: with a title, and without.
inline constexpr ImGuiWindowFlags kTitledWindow =
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings;
inline constexpr ImGuiWindowFlags kBareWindow =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

/// Begins a card over the upper middle of the relief, at most `widest_em` wide. End it with
/// ImGui::End().
void begin_card(const ViewerState& state, const char* title, float widest_em);

/// A collapsible section. The caller keeps `open`; `wanted` opens the section once and scrolls it
/// into view.
bool section(const ViewerState& state, const char* title, bool& open, bool* wanted = nullptr);

/// A row with a slider for a number.
struct NumberRow {
    const char* label;
    const char* format;  ///< printf format of a double, with the unit
    double lowest;
    double highest;   ///< of the slider; a typed number may be higher
    double standard;  ///< the default, which the small arrow restores
    const char* help{""};
    bool logarithmic{false};
    const char* zero{nullptr};  ///< shown for 0 instead of the number
    float beside{0.0F};         ///< space for another item at the right end [px]
};

/// Label, slider, and a small arrow if the value is not the default. True if the value changed.
bool number_row(const NumberRow& row, double& value);

struct DraggedRow {
    const char* label;
    const char* format;
    double lowest, highest;
    float speed;  ///< change of the value for each pixel that the mouse moves
    const char* help;
    bool changed;  ///< whether the small arrow is shown
};

/// A person's action on a row whose values take effect when the mouse button is released.
enum class Dragged { nothing, done, restore };

/// Label, values to drag side by side, and the arrow.
[[nodiscard]] Dragged dragged_row(const DraggedRow& row, std::span<double> values);

/// Check box with its label, and the arrow. True if the value changed.
bool flag_row(const char* label, bool& value, bool standard, const char* help);

/// Dimmed text beside a flag_row that has its default, aligned with the values of other rows.
void text_beside_flag(const std::string& text);

/// Label, a drop-down list, and an arrow that restores the `standard` entry. True if the choice
/// changed.
bool index_row(const char* label, std::span<const char* const> names, int& chosen, const char* help,
               int standard);

/// The same for an enumeration, by its table of names, which has_all_in_order().
template <typename Table, typename Enum>
bool choice_row(const char* label, const Table& words, Enum& chosen, const char* help,
                Enum standard = {}) {
    std::vector<const char*> names;
    names.reserve(std::size(words));
    for (const auto& word : words) names.push_back(word.label);
    int index = static_cast<int>(chosen);
    const bool changed = index_row(label, names, index, help, static_cast<int>(standard));
    chosen = static_cast<Enum>(index);
    return changed;
}

/// A text input, with `hint` while it is empty. `width` in pixels; negative: the gap to the panel's
/// edge. True if the text changed; with `enter`, if Enter was pressed.
bool text_field(const char* id, const char* hint, std::span<char> text, const char* help,
                bool enter = true, float width = -1.0F);

/// Label, a text input with `hint` while it is empty, and an arrow that clears it. True if Enter or
/// the arrow was pressed.
bool text_row(const char* label, const std::string& hint, std::span<char> text, const char* help);

/// The width of a button with that text [px].
[[nodiscard]] float button_width(const char* label);

/// The width of each of two buttons side by side [px].
[[nodiscard]] float half_width();

/// A button that makes the report of a session, as wide as there is room; its tooltip says where
/// the page is, once it was made.
void report_button(ViewerState& state, const std::filesystem::path& session);

/// A button for a typed file and, if there is room, a text that the file can be dropped instead.
/// `beside`: space left free [px]. True if the button was pressed.
bool button_or_drop(const char* label, bool enabled, const char* dropped, float beside = 0.0F);

/// A row for each touch parameter of that topic, with its label, unit, range and help. The small
/// arrow restores the value in `usual`.
void draw_parameters(TouchTopic topic, TouchParameters& parameters, TouchParameters usual = {});

/// `value` with so many digits after the point; "0.0", never "-0.0".
[[nodiscard]] std::string decimal(double value, int digits);

/// A label and a read-only value, with a tooltip.
void fact_row(const char* label, const std::string& value, const char* help = "");

/// The same for a file: its name, and the whole path as a tooltip.
void file_row(const char* label, const std::filesystem::path& file);

/// Places the next tooltip beside or above the last item's window, so that it covers no control.
void place_next_tooltip();

/// Draws a tooltip there, with the size of its text.
void draw_tooltip(const std::string& text);
/// Adds a tooltip to the last item.
void add_tooltip(const char* text);
/// The same, with the key of the action.
void add_tooltip(const std::string& text, const KeyTable& keys, Action action);

/// Dimmed text, wrapped at the panel's edge.
void draw_dimmed(const std::string& text);

/// Items that show a file's name unchanged, as ImGui's own labels cut it at "##". The caller must
/// push an ID for each.
bool name_button(const std::string& name);
/// `reached`: by the keyboard; else an item around them is.
bool name_selectable(const std::string& name, bool chosen, ImGuiSelectableFlags flags = 0,
                     bool reached = true);

/// Wrapped text in the colour of warnings, after a warning sign.
void draw_warning(const std::string& text);

/// A collapsible part of a section; true if it is open. Its rows are not indented.
bool subsection(const char* title);

/// A square button with a drawn icon and a tooltip. `lit`: its function is on. `times`: its side,
/// as a multiple of a row's height.
bool icon_button(const char* id, Icon icon, const char* help, bool lit = false, float times = 1.0F);

/// The check box whether files are opened by the desktop's dialog.
void desktop_dialog_box(OpenWith& with);

/// The play or pause button.
void play_button(bool playing, Transport& transport, const KeyTable& keys);

/// Step buttons around the play button. `step`: "frame" or "tick"; `gap` [px], negative: default.
void play_and_step_buttons(bool playing, Transport& transport, const KeyTable& keys,
                           const std::string& step, float gap = -1.0F);

void speed_row(double speed, Transport& transport);

/// The name of a texture in ImGui's type: a pointer or, from 1.91.4 on, a number.
template <typename Id>
Id texture_id(std::uintptr_t name) {
    if constexpr (std::is_pointer_v<Id>) {
        return reinterpret_cast<Id>(name);  // NOLINT(performance-no-int-to-ptr)
    } else {
        return static_cast<Id>(name);
    }
}

/// A message for stderr as a sentence for the window: with a capital letter.
std::string capitalised(std::string line);

/// A material's name as a label: "As recorded" for "as-recorded".
[[nodiscard]] std::string display_name(std::string name);

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "2026-05-31 12:00 UTC" for "2026-05-31T12:00:00Z"; other texts unchanged.
std::string date_text(const std::string& utc);

}  // namespace dibhr
