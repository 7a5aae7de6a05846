// The one table of keys: it drives what a key does, the help sheet, and every word that names a
// key; and a person's own keys for the same actions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
    /// Of a typed one its character (Unicode; of Latin letters the small one), which is where the
    /// person's layout has it; else GLFW's.
    int code{0};
    bool typed{false};
    bool control{false};
    bool shift{false};

    bool operator==(const Key&) const = default;
};

/// As the help sheet writes it: "Space", "Ctrl+Shift+F12", "Page up", "[", "G"; capital or small,
/// with or without blanks. Nothing: no key is called so.
[[nodiscard]] std::optional<Key> key_called(std::string_view name);
[[nodiscard]] std::string name_of(const Key& key);

/// What a key can do, and the keys for it where a person has none of his own.
struct KeyJob {
    Action action;
    std::string_view name;   ///< "play-or-pause", in the settings file
    std::string_view group;  ///< heading on the help sheet
    std::string_view help;
    std::array<std::string_view, 3> standard{};  ///< as for key_called(); empty: no more
    bool while_typing{
        false};           ///< also while a text field has the keyboard, unless it is typed there
    bool repeats{false};  ///< acts again and again while its key is down
    bool held{false};     ///< lasts as long as its key is down
};

/// One for each action, as the help sheet has them: a group's are neighbours.
[[nodiscard]] std::span<const KeyJob> key_jobs();
[[nodiscard]] const KeyJob& job_of(Action action);

/// What a person wants for one action, as it was written.
struct OwnKeys {
    std::string action{};             ///< KeyJob::name
    std::vector<std::string> keys{};  ///< none: no key is to do it

    bool operator==(const OwnKeys&) const = default;
};

/// What the keys do: a person's own, which are lost to the actions that had them, else the usual
/// ones. F8 always takes the force off, with and without Shift.
class KeyTable {
  public:
    KeyTable() : KeyTable(std::span<const OwnKeys>{}) {}
    /// Of two entries for one key the first one holds. An entry that says what cannot be leaves its
    /// action as it was, with a word to `complaints`, one for each entry: what it lacks and what to
    /// do, or nothing.
    explicit KeyTable(std::span<const OwnKeys> own, std::vector<std::string>* complaints = nullptr);

    [[nodiscard]] const std::vector<Key>& keys_for(Action action) const {
        return keys_[static_cast<std::size_t>(action)];
    }

    /// "Space or P", for the help sheet; "no key".
    [[nodiscard]] std::string names_for(Action action) const;
    /// The first of them, to be told elsewhere.
    [[nodiscard]] std::string name_for(Action action) const;
    /// " (Space)", to follow what a button does; empty: it has no key.
    [[nodiscard]] std::string in_brackets(Action action) const;

    /// ": Ctrl+R begins", to end a sentence with; empty: it has no key.
    [[nodiscard]] std::string told(Action action, std::string_view does) const;

    /// GLFW's keys of an action that lasts while one of them is held.
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
    /// With Shift, too, unless that is another action's.
    [[nodiscard]] std::optional<Action> action_of(const Key& key) const;

    std::array<std::vector<Key>, kActions> keys_{};
};

/// What a key does in a list to choose from.
enum class ListKey { up, down, take };

/// Nothing: it is for something else.
[[nodiscard]] std::optional<ListKey> list_key(int key);

}  // namespace dibhr
