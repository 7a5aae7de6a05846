// The table of keys, the user's own keys in it, and look-up.
#include "app/settings/keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// Acts once at a press, and not while text is typed. `keys`: the default keys.
template <typename... Keys>
constexpr KeyJob job(Action action, std::string_view name, std::string_view group,
                     std::string_view help, Keys... keys) {
    return {action, name, group, help, {keys...}};
}

constexpr KeyJob while_typing(KeyJob one) {
    one.while_typing = true;
    return one;
}

constexpr KeyJob repeating(KeyJob one) {
    one.repeats = true;
    return one;
}

constexpr KeyJob while_held(KeyJob one) {
    one.held = true;
    return one;
}

// Headings of the help sheet.
constexpr const char* kTouch = "Touch";
constexpr const char* kPlayback = "Playback";
constexpr const char* kView = "View";
constexpr const char* kProgram = "Program";

constexpr KeyJob kJobs[] = {
    job(Action::toggle_force, "toggle-force", kTouch, "Force off, force on again", "F"),
    while_typing(job(Action::force_off, "force-off", kTouch, "Force off, never on", "F8")),
    job(Action::centre_workspace, "centre-workspace", kTouch,
        "Centre the device's workspace in the image", "C"),
    while_typing(job(Action::record, "record", kTouch, "Record what is touched, stop", "Ctrl+R")),
    job(Action::toggle_sound, "toggle-sound", kTouch, "Sound of touch off, on", "U"),
    job(Action::mark, "mark", kTouch, "Mark this moment of the recording", "M"),
    job(Action::explain, "explain", kTouch, "Explain an update step by step; end it", "E"),
    job(Action::toggle_brush, "toggle-brush", kTouch,
        "Brush that paints materials on the relief; end it", "G"),
    job(Action::undo, "undo", kTouch, "Take back what was painted", "Ctrl+Z"),
    job(Action::redo, "redo", kTouch, "Paint it again", "Ctrl+Shift+Z"),
    job(Action::touch_by_keys, "touch-by-keys", kTouch,
        "Arrows move the hand, Space presses; end it", "T"),
    job(Action::toggle_others, "toggle-others", kTouch, "Proxies of the other algorithms on, off",
        "O"),
    job(Action::play_or_pause, "play-or-pause", kPlayback, "Play, pause", "Space", "P"),
    repeating(job(Action::step_forward, "step-forward", kPlayback,
                  "One frame forward; in a replay, one tick", ".")),
    repeating(job(Action::step_back, "step-back", kPlayback,
                  "One frame back; in a replay, one tick", ",")),
    repeating(job(Action::seek_forward_little, "seek-forward-little", kPlayback, "1 s forward",
                  "Shift+Right")),
    repeating(
        job(Action::seek_back_little, "seek-back-little", kPlayback, "1 s back", "Shift+Left")),
    repeating(job(Action::seek_forward, "seek-forward", kPlayback, "5 s forward", "Right")),
    repeating(job(Action::seek_back, "seek-back", kPlayback, "5 s back", "Left")),
    repeating(job(Action::seek_forward_far, "seek-forward-far", kPlayback, "60 s forward", "Up")),
    repeating(job(Action::seek_back_far, "seek-back-far", kPlayback, "60 s back", "Down")),
    job(Action::go_to_start, "go-to-start", kPlayback, "To the start", "Home"),
    job(Action::go_to_end, "go-to-end", kPlayback, "To the last second", "End"),
    repeating(job(Action::slower, "slower", kPlayback, "Slower", "[", "-")),
    repeating(job(Action::faster, "faster", kPlayback, "Faster", "]", "+", "=")),
    job(Action::half_speed, "half-speed", kPlayback, "Half the speed", "{", "Page down"),
    job(Action::double_speed, "double-speed", kPlayback, "Twice the speed", "}", "Page up"),
    job(Action::normal_speed, "normal-speed", kPlayback, "Normal speed", "Backspace"),
    job(Action::toggle_loop, "toggle-loop", kPlayback, "Loop on, off", "L"),
    job(Action::loop_part, "loop-part", kPlayback, "Set the loop's start; its end; play all", "A"),
    job(Action::reset_view, "reset-view", kView, "Reset the view", "R"),
    job(Action::toggle_straight_view, "toggle-straight-view", kView, "Straight view, perspective",
        "V"),
    while_held(job(Action::show_as_recorded, "show-as-recorded", kView,
                   "Depth as recorded, before cleaning", "B")),
    job(Action::turn_depth, "turn-depth", kView, "Turn near and far of the depth, and back", "X"),
    job(Action::next_paint, "next-paint", kView, "Show video colour, clay, or depth colours", "D"),
    job(Action::toggle_panes, "toggle-panes", kView,
        "Colour and depth as pictures above the relief", "K"),
    job(Action::toggle_ruler, "toggle-ruler", kView,
        "Ruler between two clicks on the relief; end it", "N"),
    job(Action::toggle_statistics, "toggle-statistics", kView, "Statistics over the relief", "I"),
    job(Action::copy_view, "copy-view", kView, "Copy the camera's view", "Ctrl+C"),
    job(Action::paste_view, "paste-view", kView, "Take the copied view", "Ctrl+V"),
    job(Action::toggle_panels, "toggle-panels", kView, "Hide the panels, show them", "Tab"),
    while_typing(job(Action::next_pane, "next-pane", kView,
                     "Keyboard to the toolbar, the panels, the bar; Esc: back to the picture",
                     "F6")),
    while_typing(job(Action::previous_pane, "previous-pane", kView,
                     "The same in the other direction", "Shift+F6")),
    while_typing(
        job(Action::toggle_full_screen, "toggle-full-screen", kView, "Full screen on, off", "F11")),
    while_typing(job(Action::open_file, "open-file", kProgram, "Open files", "Ctrl+O")),
    while_typing(job(Action::open_file_in_window, "open-file-in-window", kProgram,
                     "Open files in this window, with previews", "Ctrl+Shift+O")),
    while_typing(job(Action::next_file, "next-file", kProgram, "The next file of the folder",
                     "Ctrl+Page down")),
    while_typing(job(Action::previous_file, "previous-file", kProgram, "The file before it",
                     "Ctrl+Page up")),
    while_typing(job(Action::take_screenshot, "take-screenshot", kProgram,
                     "Save a picture, by default into the current folder", "S", "F12")),
    while_typing(job(Action::take_screenshot_of_relief, "take-screenshot-of-relief", kProgram,
                     "Save a picture without panels", "Shift+F12")),
    while_typing(job(Action::take_clip, "take-clip", kProgram, "Save a clip (MP4), end it", "F9")),
    while_typing(job(Action::take_clip_of_relief, "take-clip-of-relief", kProgram,
                     "Save a clip without panels, end it", "Shift+F9")),
    while_typing(job(Action::toggle_help, "toggle-help", kProgram, "This sheet", "?", "F1", "H")),
    while_typing(job(Action::close_topmost, "close-topmost", kProgram,
                     "Close this sheet or a message", "Esc")),
    while_typing(job(Action::quit, "quit", kProgram, "Quit", "Q", "Ctrl+Q")),
};

static_assert(std::size(kJobs) == kActions);

/// A key that types no character.
struct NamedKey {
    std::string_view name;
    int code;
};

constexpr NamedKey kNamedKeys[] = {
    {"Esc", GLFW_KEY_ESCAPE},      {"Enter", GLFW_KEY_ENTER},
    {"Tab", GLFW_KEY_TAB},         {"Backspace", GLFW_KEY_BACKSPACE},
    {"Insert", GLFW_KEY_INSERT},   {"Delete", GLFW_KEY_DELETE},
    {"Right", GLFW_KEY_RIGHT},     {"Left", GLFW_KEY_LEFT},
    {"Down", GLFW_KEY_DOWN},       {"Up", GLFW_KEY_UP},
    {"Page up", GLFW_KEY_PAGE_UP}, {"Page down", GLFW_KEY_PAGE_DOWN},
    {"Home", GLFW_KEY_HOME},       {"End", GLFW_KEY_END},
    {"Pause", GLFW_KEY_PAUSE},     {"Print screen", GLFW_KEY_PRINT_SCREEN},
    {"Menu", GLFW_KEY_MENU},       {"F1", GLFW_KEY_F1},
    {"F2", GLFW_KEY_F2},           {"F3", GLFW_KEY_F3},
    {"F4", GLFW_KEY_F4},           {"F5", GLFW_KEY_F5},
    {"F6", GLFW_KEY_F6},           {"F7", GLFW_KEY_F7},
    {"F8", GLFW_KEY_F8},           {"F9", GLFW_KEY_F9},
    {"F10", GLFW_KEY_F10},         {"F11", GLFW_KEY_F11},
    {"F12", GLFW_KEY_F12},         {"F13", GLFW_KEY_F13},
    {"F14", GLFW_KEY_F14},         {"F15", GLFW_KEY_F15},
    {"F16", GLFW_KEY_F16},         {"F17", GLFW_KEY_F17},
    {"F18", GLFW_KEY_F18},         {"F19", GLFW_KEY_F19},
    {"F20", GLFW_KEY_F20},         {"F21", GLFW_KEY_F21},
    {"F22", GLFW_KEY_F22},         {"F23", GLFW_KEY_F23},
    {"F24", GLFW_KEY_F24}};

/// In the order of HandKey.
constexpr int kHandKeys[] = {GLFW_KEY_LEFT,  GLFW_KEY_RIGHT, GLFW_KEY_UP,      GLFW_KEY_DOWN,
                             GLFW_KEY_SPACE, GLFW_KEY_ENTER, GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN};
static_assert(std::size(kHandKeys) == static_cast<std::size_t>(HandKey::farther) + 1);

constexpr std::string_view kSpace = "Space";
constexpr std::string_view kControl = "Ctrl+";
constexpr std::string_view kShift = "Shift+";

int lower_case(int c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

int upper_case(int c) {
    return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
}

bool is_letter(int c) {
    return lower_case(c) >= 'a' && lower_case(c) <= 'z';
}

/// A name in lower case without blanks: "pageup".
std::string plain(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (c != ' ') letters += static_cast<char>(lower_case(c));
    return letters;
}

/// Removes `prefix` from a text made by plain(); false: the text does not begin with it.
bool takes_away(std::string_view& text, std::string_view prefix) {
    if (text.size() <= prefix.size() || !text.starts_with(plain(prefix))) return false;
    text.remove_prefix(prefix.size());
    return true;
}

/// The character of a UTF-8 text of one visible character; nothing: another text.
std::optional<int> only_character(std::string_view text) {
    constexpr int kFirstSeen = 0x21;
    constexpr int kDelete = 0x7F;
    constexpr int kLastUnseen = 0xA0;
    if (text.empty()) return std::nullopt;
    const auto first = static_cast<std::uint8_t>(text.front());
    const std::size_t bytes = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    const bool amid = (first & 0xC0) == 0x80;  // a continuation byte
    if (amid || text.size() != bytes) return std::nullopt;
    int code = bytes == 1 ? first : first & (0xFF >> (bytes + 1));
    for (const char next : text.substr(1))
        code = code << 6 | (static_cast<std::uint8_t>(next) & 0x3F);
    const bool seen = code >= kFirstSeen && (code < kDelete || code > kLastUnseen);
    return seen ? std::optional(lower_case(code)) : std::nullopt;
}

std::string in_utf8(int code) {
    if (code < 0x80) return {static_cast<char>(code)};
    std::string text;
    int shift = code < 0x800 ? 6 : code < 0x10000 ? 12 : 18;
    const int mark = shift == 6 ? 0xC0 : shift == 12 ? 0xE0 : 0xF0;
    text += static_cast<char>(mark | code >> shift);
    while (shift > 0) {
        shift -= 6;
        text += static_cast<char>(0x80 | (code >> shift & 0x3F));
    }
    return text;
}

/// GLFW's key that types a character by itself on a US keyboard; 0: none does.
int key_typing(int character) {
    constexpr std::string_view kOthers = " ',-./0123456789;=[\\]`";
    const bool other = character > 0 && character < 0x80 &&
                       kOthers.find(static_cast<char>(character)) != std::string_view::npos;
    return is_letter(character) || other ? upper_case(character) : 0;
}

/// The key of a character. With Ctrl it is GLFW's key, as nothing is typed then.
std::optional<Key> character_key(int character, bool control, bool shift) {
    if (control) {
        const int code = key_typing(character);
        return code != 0 ? std::optional(Key{code, false, true, shift}) : std::nullopt;
    }
    // With Shift, keys of other characters type another character.
    const bool one = !shift || is_letter(character) || character == ' ';
    return one ? std::optional(Key{character, true, false, shift}) : std::nullopt;
}

/// GLFW's key code to check whether the key is held; 0: it cannot be checked.
int held_code(const Key& key) {
    if (key.control || key.shift) return 0;
    return key.typed ? key_typing(key.code) : key.code;
}

/// Whether a text field with the keyboard uses this key itself.
bool edits_text(const Key& key) {
    constexpr int kEditing[] = {GLFW_KEY_ENTER,  GLFW_KEY_TAB,  GLFW_KEY_BACKSPACE, GLFW_KEY_INSERT,
                                GLFW_KEY_DELETE, GLFW_KEY_LEFT, GLFW_KEY_RIGHT,     GLFW_KEY_UP,
                                GLFW_KEY_DOWN,   GLFW_KEY_HOME, GLFW_KEY_END};
    constexpr int kWithControl[] = {GLFW_KEY_A, GLFW_KEY_C, GLFW_KEY_V,
                                    GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_Z};
    const auto among = [&key](const auto& codes) {
        return std::ranges::find(codes, key.code) != std::end(codes);
    };
    return key.typed || among(kEditing) || (key.control && among(kWithControl));
}

bool holds(const std::vector<Key>& keys, const Key& key) {
    return std::ranges::find(keys, key) != keys.end();
}

const KeyJob* job_called(std::string_view name) {
    const auto* const found = std::ranges::find(kJobs, name, &KeyJob::name);
    return found == std::end(kJobs) ? nullptr : found;
}

/// F8, which always takes the force off, also with Shift.
bool is_kept_for_force_off(const Key& key) {
    return !key.typed && key.code == GLFW_KEY_F8 && !key.control;
}

/// The valid entries of the user's own keys.
class ValidOwnKeys {
  public:
    /// What is wrong with the entry; empty: valid, and added.
    std::string take(const OwnKeys& entry) {
        const KeyJob* const job = job_called(entry.action);
        if (job == nullptr) return "is not an action: dibhr help keys lists them";
        if (job->action == Action::force_off && entry.keys.empty())
            return "cannot be without a key: F8 always takes the force off; remove the entry";
        std::vector<Key> keys;
        for (const std::string& name : entry.keys) {
            const std::optional<Key> key = key_named(name);
            std::string problem = problem_of(key, *job);
            if (!problem.empty())
                return "names " + in_quotes(name) + ", " + problem + "; the default keys stay";
            if (!holds(keys, *key)) keys.push_back(*key);
        }
        own_[static_cast<std::size_t>(job->action)] = std::move(keys);
        return {};
    }

    /// The final keys of an action.
    [[nodiscard]] std::vector<Key> keys_for(const KeyJob& job) const {
        const auto& own = own_[static_cast<std::size_t>(job.action)];
        std::vector<Key> keys;
        const bool usual = !own || job.action == Action::force_off;
        for (const std::string_view name : job.standard) {
            if (!usual || name.empty()) break;
            const Key key = *key_named(name);
            if (owner_of(key) == nullptr) keys.push_back(key);
        }
        if (own) keys.insert(keys.end(), own->begin(), own->end());
        return keys;
    }

  private:
    [[nodiscard]] std::string problem_of(const std::optional<Key>& key, const KeyJob& job) const {
        if (!key)
            return "which is not a key: write one as dibhr help keys does, like Space or Ctrl+R";
        if (job.held && held_code(*key) == 0)
            return "which cannot be held: choose one key without Ctrl and Shift";
        if (is_kept_for_force_off(*key) && job.action != Action::force_off)
            return "which always takes the force off: choose another one";
        const KeyJob* const owner = owner_of(*key);
        if (owner != nullptr)
            return "which is already for " + std::string(owner->name) + ": choose another one";
        return {};
    }

    /// The action for which the user has chosen this key; null: none.
    [[nodiscard]] const KeyJob* owner_of(const Key& key) const {
        for (const KeyJob& job : kJobs) {
            const auto& own = own_[static_cast<std::size_t>(job.action)];
            if (own && holds(*own, key)) return &job;
        }
        return nullptr;
    }

    std::array<std::optional<std::vector<Key>>, kActions> own_{};
};

}  // namespace

std::optional<Key> key_named(std::string_view name) {
    const std::string letters = plain(name);
    std::string_view rest = letters;
    const bool control = takes_away(rest, kControl);
    const bool shift = takes_away(rest, kShift);
    if (rest == plain(kSpace)) return character_key(' ', control, shift);
    for (const NamedKey& named : kNamedKeys)
        if (rest == plain(named.name)) return Key{named.code, false, control, shift};
    const auto character = only_character(rest);
    return character ? character_key(*character, control, shift) : std::nullopt;
}

std::string name_of(const Key& key) {
    std::string name;
    if (key.control) name += kControl;
    if (key.shift) name += kShift;
    if (key.code == ' ') return name.append(kSpace);
    const auto* const named = std::ranges::find(kNamedKeys, key.code, &NamedKey::code);
    if (!key.typed && named != std::end(kNamedKeys)) return name.append(named->name);
    return name + in_utf8(upper_case(key.code));
}

std::span<const KeyJob> key_jobs() {
    return kJobs;
}

const KeyJob& job_of(Action action) {
    return *std::ranges::find(kJobs, action, &KeyJob::action);
}

KeyTable::KeyTable(std::span<const OwnKeys> own, std::vector<std::string>* complaints) {
    ValidOwnKeys valid;
    for (const OwnKeys& entry : own) {
        std::string problem = valid.take(entry);
        if (complaints != nullptr) complaints->push_back(std::move(problem));
    }
    for (const KeyJob& job : kJobs)
        keys_[static_cast<std::size_t>(job.action)] = valid.keys_for(job);
}

std::string KeyTable::names_for(Action action) const {
    const std::vector<Key>& keys = keys_for(action);
    if (keys.empty()) return "no key";
    std::string names;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k > 0) names += k + 1 < keys.size() ? ", " : " or ";
        names += name_of(keys[k]);
    }
    if (job_of(action).held) names += ", held";
    return names;
}

std::string KeyTable::name_for(Action action) const {
    const std::vector<Key>& keys = keys_for(action);
    return keys.empty() ? std::string() : name_of(keys.front());
}

std::string KeyTable::in_brackets(Action action) const {
    const std::string name = name_for(action);
    if (name.empty()) return {};
    const bool sign = name.size() == 1 && !is_letter(name.front());
    const char* const gap = sign ? " " : "";  // a "." alone is hard to see
    return " (" + (gap + name) + gap + ")";
}

std::string KeyTable::key_hint(Action action, std::string_view does) const {
    const std::string name = name_for(action);
    return name.empty() ? name : ": " + name + std::string(does);
}

std::vector<int> KeyTable::held_keys(Action action) const {
    std::vector<int> codes;
    for (const Key& key : keys_for(action)) codes.push_back(held_code(key));
    return codes;
}

std::optional<Action> KeyTable::action_of(const Key& key) const {
    for (const KeyJob& job : kJobs)
        if (!job.held && holds(keys_for(job.action), key)) return job.action;
    if (!key.shift) return std::nullopt;
    Key alone = key;
    alone.shift = false;
    return action_of(alone);
}

std::optional<Action> KeyTable::action_of_character(unsigned character, bool repeated,
                                                    bool shift) const {
    const auto action = action_of({lower_case(static_cast<int>(character)), true, false, shift});
    return action && (job_of(*action).repeats || !repeated) ? action : std::nullopt;
}

std::optional<Action> KeyTable::action_of_key(int key, bool control, bool typing, bool repeated,
                                              bool shift) const {
    const Key pressed{key, false, control, shift};
    const auto action = action_of(pressed);
    if (!action) return std::nullopt;
    const KeyJob& job = job_of(*action);
    const bool heard = !typing || (job.while_typing && !edits_text(pressed));
    return heard && (job.repeats || !repeated) ? action : std::nullopt;
}

std::optional<int> digit_of(int key) {
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return key - GLFW_KEY_0;
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return key - GLFW_KEY_KP_0;
    return std::nullopt;
}

std::optional<ListKey> list_key(int key) {
    if (key == GLFW_KEY_UP) return ListKey::up;
    if (key == GLFW_KEY_DOWN) return ListKey::down;
    if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) return ListKey::take;
    if (key == GLFW_KEY_TAB) return ListKey::complete;
    return std::nullopt;
}

std::optional<HandKey> hand_key(int key) {
    if (key == GLFW_KEY_KP_ENTER) return HandKey::keep_pressing;
    const auto* const found = std::ranges::find(kHandKeys, key);
    if (found == std::end(kHandKeys)) return std::nullopt;
    return static_cast<HandKey>(found - std::begin(kHandKeys));
}

int code_of(HandKey key) {
    return kHandKeys[static_cast<std::size_t>(key)];
}

}  // namespace dibhr
