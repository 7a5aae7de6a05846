// The table of keys, for key actions, the help sheet and every text that names a key; and the
// user's own keys for the same actions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// What a key can do.
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
    touch_by_keys,
    toggle_others,
    reset_view,
    toggle_straight_view,
    show_as_recorded,
    turn_depth,
    toggle_panels,
    next_pane,
    previous_pane,
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
    open_file_in_window,
    next_file,
    previous_file,
    toggle_help,
    close_topmost,
    quit,
};

inline constexpr std::size_t kActions = static_cast<std::size_t>(Action::quit) + 1;

/// One key, alone or with others that are held down.
struct Key {
    /// `typed`: the character (Unicode; Latin letters in lower case), wherever the layout has it.
    /// Else GLFW's key code.
    int code{0};
    bool typed{false};
    bool control{false};
    bool shift{false};

    bool operator==(const Key&) const = default;
};

/// The key of a name as on the help sheet: "Space", "Ctrl+Shift+F12", "Page up", "[", "G"; in any
/// case, with or without blanks. Nothing: no key has that name.
[[nodiscard]] std::optional<Key> key_named(std::string_view name);
[[nodiscard]] std::string name_of(const Key& key);

/// An action of keys, and its default keys.
struct KeyJob {
    Action action;
    std::string_view name;   ///< "play-or-pause", in the settings file
    std::string_view group;  ///< heading on the help sheet
    std::string_view help;
    std::array<std::string_view, 3> standard{};  ///< default keys, as key_named() takes them
    bool while_typing{
        false};           ///< also while a text field has the keyboard, unless it is typed there
    bool repeats{false};  ///< repeats while its key is down
    bool held{false};     ///< active as long as its key is down
};

/// One row for each action, in the help sheet's order: the actions of a group are neighbours.
[[nodiscard]] std::span<const KeyJob> key_jobs();
[[nodiscard]] const KeyJob& job_of(Action action);

/// The user's keys for one action, as written in the settings file.
struct OwnKeys {
    std::string action{};             ///< KeyJob::name
    std::vector<std::string> keys{};  ///< empty: no key for this action

    bool operator==(const OwnKeys&) const = default;
};

/// The keys of all actions: the user's own, which are taken from the actions that had them, else
/// the defaults. F8 always takes the force off, with and without Shift.
class KeyTable {
  public:
    KeyTable() : KeyTable(std::span<const OwnKeys>{}) {}
    /// Of two entries for one key the first one counts. An invalid entry leaves its action with the
    /// default keys. `complaints` gets a text for each entry: what is wrong and what to do; empty:
    /// valid.
    explicit KeyTable(std::span<const OwnKeys> own, std::vector<std::string>* complaints = nullptr);

    [[nodiscard]] const std::vector<Key>& keys_for(Action action) const {
        return keys_[static_cast<std::size_t>(action)];
    }

    /// "Space or P", for the help sheet; "no key".
    [[nodiscard]] std::string names_for(Action action) const;
    /// The first of them, for other texts.
    [[nodiscard]] std::string name_for(Action action) const;
    /// " (Space)", to append to a button's label; empty: the action has no key.
    [[nodiscard]] std::string in_brackets(Action action) const;

    /// ": Ctrl+R begins", to append to a sentence; empty: the action has no key.
    [[nodiscard]] std::string key_hint(Action action, std::string_view does) const;

    /// GLFW's key codes of an action that is active while one of them is held.
    [[nodiscard]] std::vector<int> held_keys(Action action) const;

    /// The action of a typed character, a Unicode code point; `repeated`: its key is being held
    /// down.
    [[nodiscard]] std::optional<Action> action_of_character(unsigned character,
                                                            bool repeated = false,
                                                            bool shift = false) const;

    /// The action of a pressed GLFW key. `typing`: a text field has the keyboard.
    [[nodiscard]] std::optional<Action> action_of_key(int key, bool control, bool typing,
                                                      bool repeated = false,
                                                      bool shift = false) const;

  private:
    /// A key also acts with Shift, unless that is the key of another action.
    [[nodiscard]] std::optional<Action> action_of(const Key& key) const;

    std::array<std::vector<Key>, kActions> keys_{};
};

/// The number on a key, also on the number pad: 0 to 9, wherever the layout types it. Nothing: the
/// key has none.
[[nodiscard]] std::optional<int> digit_of(int key);

/// What a key does in a list of choices under a text line.
enum class ListKey { up, down, take, complete };

/// Nothing: the key has no meaning in a list.
[[nodiscard]] std::optional<ListKey> list_key(int key);

/// What a key does to the hand that keys move.
enum class HandKey { left, right, up, down, press, keep_pressing, nearer, farther };

/// Nothing: the key means nothing to the hand.
[[nodiscard]] std::optional<HandKey> hand_key(int key);
/// GLFW's code of its key; of `keep_pressing` one of two.
[[nodiscard]] int code_of(HandKey key);

}  // namespace dibhr
