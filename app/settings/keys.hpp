// The one table of keys: it drives what a key does and the help sheet.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace dibhr {

/// What a key can ask for.
enum class Action {
    play_or_pause,
    step_forward,
    step_back,
    seek_forward,
    seek_back,
    seek_forward_little,
    seek_back_little,
    seek_forward_far,
    seek_back_far,
    go_to_start,
    go_to_end,
    faster,
    slower,
    double_speed,
    half_speed,
    normal_speed,
    toggle_loop,
    loop_part,
    toggle_force,
    force_off,
    centre_workspace,
    toggle_sound,
    record,
    mark,
    explain,
    toggle_brush,
    undo,
    redo,
    toggle_others,
    reset_view,
    toggle_straight_view,
    show_as_recorded,
    toggle_panels,
    toggle_statistics,
    next_paint,
    toggle_panes,
    toggle_ruler,
    copy_view,
    paste_view,
    toggle_full_screen,
    take_screenshot,
    take_screenshot_of_relief,
    take_clip,
    take_clip_of_relief,
    open_file,
    next_file,
    previous_file,
    toggle_help,
    close_topmost,
    quit,
};

/// One job and the keys for it. Bound by the character typed where the layout matters, by key
/// otherwise.
struct KeyBinding {
    Action action;
    std::string_view group;  ///< heading on the help sheet
    std::string_view shown;  ///< "Space or P"
    std::string_view help;
    std::string_view characters{};  ///< any of these typed; letters match both cases
    int keys[2]{0, 0};              ///< GLFW keys; 0: none
    bool with_control{false};       ///< for `keys`
    bool with_shift{false};         ///< for `keys`; a row without it takes them with Shift, too
    bool while_typing{false};       ///< also acts while a text field has the keyboard
    bool repeats{false};            ///< acts again and again while held down
};

[[nodiscard]] std::span<const KeyBinding> key_bindings();

/// The GLFW key of an action that lasts while it is held.
[[nodiscard]] int held_key(Action action);

/// The action of a typed character, a Unicode code point; `repeated`: its key is being held down.
[[nodiscard]] std::optional<Action> action_of_character(unsigned character, bool repeated = false);

/// The action of a pressed GLFW key. `typing`: a text field has the keyboard.
[[nodiscard]] std::optional<Action> action_of_key(int key, bool control, bool typing,
                                                  bool repeated = false, bool shift = false);

/// What a key does in a list to choose from.
enum class ListKey { up, down, take };

/// Nothing: it is for something else.
[[nodiscard]] std::optional<ListKey> list_key(int key);

}  // namespace dibhr
