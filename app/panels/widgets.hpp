// Rows and icons that all panels are made of.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/playing/transport.hpp"

namespace dibhr {

/// Of windows that stay where they are put: with a title, and bare ones.
inline constexpr ImGuiWindowFlags kTitledWindow =
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings;
inline constexpr ImGuiWindowFlags kBareWindow =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

/// A card over the relief, in the middle of its upper part and at most so wide; to be ended with
/// ImGui::End().
void begin_card(const ViewerState& state, const char* title, float widest_em);

/// A collapsible section; `open` is kept by the caller, `wanted` opens it once and brings it into
/// sight.
bool section(const ViewerState& state, const char* title, bool& open, bool* wanted = nullptr);

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
    float beside{0.0F};         ///< left free at the right end, for another item [px]
};

/// Label, slider, and a small arrow when the value is not the standard one. True when it changed.
bool number_row(const NumberRow& row, double& value);

struct DraggedRow {
    const char* label;
    const char* format;
    double lowest, highest;
    float speed;  ///< of a value, for a pixel of the mouse
    const char* help;
    bool changed;  ///< whether the small arrow shows
};

/// What a person does with a row of values that take effect when they let go.
enum class Dragged { nothing, done, put_back };

/// Label, values to drag side by side, and the arrow.
[[nodiscard]] Dragged dragged_row(const DraggedRow& row, std::span<double> values);

/// Label and tick box, and the arrow. True when it changed.
bool flag_row(const char* label, bool& value, bool standard, const char* help);

/// Quiet text beside a flag_row of the standard value, under the values of the rows above.
void beside_flag(const std::string& text);

/// Label, a list to choose from, and an arrow back to the `standard` entry. True when the choice
/// changed.
bool index_row(const char* label, std::span<const char* const> names, int& chosen, const char* help,
               int standard);

/// The same for an enumeration, from its table of words, which has_all_in_order().
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

/// A line to type into, `hint` while it is empty; `width` in pixels, negative: up to so far from
/// the panel's edge. True when it changed; with `enter`, when Enter was pressed.
bool text_field(const char* id, const char* hint, std::span<char> text, const char* help,
                bool enter = true, float width = -1.0F);

/// Label, a line to type into with `hint` while it is empty, and an arrow that empties it. True
/// when Enter or the arrow was pressed.
bool text_row(const char* label, const std::string& hint, std::span<char> text, const char* help);

/// Of a button with that text [px].
[[nodiscard]] float button_width(const char* label);

/// Of the first of two buttons side by side [px].
[[nodiscard]] float half_width();

/// A button that asks for a report of a session, as wide as there is room.
void report_button(ViewerState& state, const std::filesystem::path& session);

/// A button for what was typed, and, where there is room, that it can be dropped instead; `beside`
/// is left free [px]. True when it was pressed.
bool button_or_drop(const char* label, bool enabled, const char* dropped, float beside = 0.0F);

/// A row for each touch parameter of that topic, with its label, unit, range and help; the small
/// arrow puts back what is `usual`.
void draw_parameters(TouchTopic topic, TouchParameters& parameters, TouchParameters usual = {});

/// With so many digits after the point, and no sign where they are all 0.
[[nodiscard]] std::string decimal(double value, int digits);

/// A name and a value to read, and what they mean.
void fact_row(const char* label, const std::string& value, const char* help = "");

/// The same for a file: its name, and the whole path as a tooltip.
void file_row(const char* label, const std::filesystem::path& file);

/// Beside the last item's window, or above it: a tooltip covers none of its controls.
void place_next_tooltip();

/// The tooltip of the last item.
void explain(const char* text);
/// The same, and the key that does it.
void explain(const std::string& text, const KeyTable& keys, Action action);

/// Text that breaks at the panel's edge, in the quiet colour.
void quiet_text(const std::string& text);

/// Of a file's name, as it is: in ImGui's own labels "##" is not shown. Each needs an ID of its
/// own.
bool name_button(const std::string& name);
bool name_selectable(const std::string& name, bool chosen, ImGuiSelectableFlags flags = 0);

/// The same in the colour of trouble, behind a warning sign.
void trouble_text(const std::string& text);

/// A collapsible part of a section; true when it is open. Its rows are not indented.
bool part(const char* title);

enum class Icon { play, pause, step_back, step_forward, loop, put_back };

/// A square button with a drawn icon and a tooltip; a lit one says that what it stands for is on.
bool icon_button(const char* id, Icon icon, const char* help, bool lit = false);

/// Whether Ctrl+O asks the desktop.
void desktop_dialog_box(OpenWith& with);

/// Play or pause.
void play_button(bool playing, Transport& transport, const KeyTable& keys);

/// Steps on both sides of it; `step` is what one goes by, `gap` in pixels, negative: the usual.
void play_and_step_buttons(bool playing, Transport& transport, const KeyTable& keys,
                           const std::string& step, float gap = -1.0F);

void speed_row(double speed, Transport& transport);

/// The name of a texture as ImGui wants it: as a pointer, or, from 1.91.4 on, as a number.
template <typename Id>
Id texture_id(std::uintptr_t name) {
    if constexpr (std::is_pointer_v<Id>) {
        return reinterpret_cast<Id>(name);  // NOLINT(performance-no-int-to-ptr)
    } else {
        return static_cast<Id>(name);
    }
}

/// A line for stderr as a sentence for the window: with a capital letter.
std::string capitalised(std::string line);

/// "as-recorded" as "As recorded": a file's name without its ending, for a person.
[[nodiscard]] std::string spoken_name(std::string name);

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "2026-05-31T12:00:00Z" as "2026-05-31 12:00 UTC"; another text as it is.
std::string date_text(const std::string& utc);

}  // namespace dibhr
