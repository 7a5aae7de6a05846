// The table of keys, and looking things up in it.
#include "app/settings/keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>

namespace dibhr {

namespace {

constexpr KeyBinding while_typing(KeyBinding binding) {
    binding.while_typing = true;
    return binding;
}

constexpr KeyBinding with_control(KeyBinding binding) {
    binding.with_control = true;
    return while_typing(binding);
}

/// While a text field has the keyboard it takes them itself.
constexpr KeyBinding on_control(KeyBinding binding) {
    binding.with_control = true;
    return binding;
}

constexpr KeyBinding with_shift(KeyBinding binding) {
    binding.with_shift = true;
    return binding;
}

constexpr KeyBinding repeating(KeyBinding binding) {
    binding.repeats = true;
    return binding;
}

// Headings of the help sheet.
constexpr const char* kTouch = "Touch";
constexpr const char* kPlayback = "Playback";
constexpr const char* kView = "View";
constexpr const char* kProgram = "Program";

constexpr KeyBinding kBindings[] = {
    {Action::toggle_force, kTouch, "F", "Force off, force on again", "f"},
    while_typing(
        {Action::force_off, kTouch, "F8", "Force off, whatever it was", "", {GLFW_KEY_F8}}),
    {Action::centre_workspace, kTouch, "C", "Centre the device's hand in the image", "c"},
    with_control(
        {Action::record, kTouch, "Ctrl+R", "Record what is touched, stop", "", {GLFW_KEY_R}}),
    {Action::toggle_sound, kTouch, "U", "Sound of touch off, on", "u"},
    {Action::mark, kTouch, "M", "Mark this moment of the recording", "m"},
    {Action::explain, kTouch, "E", "Explain an update step by step; end it", "e"},
    {Action::toggle_others, kTouch, "O", "Proxies of the other algorithms on, off", "o"},
    {Action::play_or_pause, kPlayback, "Space or P", "Play, pause", " p"},
    repeating(
        {Action::step_forward, kPlayback, ".", "One frame forward; in a replay, one tick", "."}),
    repeating({Action::step_back, kPlayback, ",", "One frame back; in a replay, one tick", ","}),
    // Before those without Shift, which take the same keys.
    repeating(with_shift({Action::seek_forward_little,
                          kPlayback,
                          "Shift+Right",
                          "1 s forward",
                          "",
                          {GLFW_KEY_RIGHT}})),
    repeating(with_shift(
        {Action::seek_back_little, kPlayback, "Shift+Left", "1 s back", "", {GLFW_KEY_LEFT}})),
    repeating({Action::seek_forward, kPlayback, "Right", "5 s forward", "", {GLFW_KEY_RIGHT}}),
    repeating({Action::seek_back, kPlayback, "Left", "5 s back", "", {GLFW_KEY_LEFT}}),
    repeating({Action::seek_forward_far, kPlayback, "Up", "60 s forward", "", {GLFW_KEY_UP}}),
    repeating({Action::seek_back_far, kPlayback, "Down", "60 s back", "", {GLFW_KEY_DOWN}}),
    {Action::go_to_start, kPlayback, "Home", "To the start", "", {GLFW_KEY_HOME}},
    {Action::go_to_end, kPlayback, "End", "To the last second", "", {GLFW_KEY_END}},
    repeating({Action::slower, kPlayback, "[ or -", "Slower", "[-"}),
    repeating({Action::faster, kPlayback, "] or +", "Faster", "]+="}),
    {Action::half_speed, kPlayback, "{ or Page down", "Half the speed", "{", {GLFW_KEY_PAGE_DOWN}},
    {Action::double_speed, kPlayback, "} or Page up", "Twice the speed", "}", {GLFW_KEY_PAGE_UP}},
    {Action::normal_speed, kPlayback, "Backspace", "Normal speed", "", {GLFW_KEY_BACKSPACE}},
    {Action::toggle_loop, kPlayback, "L", "Loop on, off", "l"},
    {Action::loop_part, kPlayback, "A", "Loop from here; to here; all again", "a"},
    {Action::reset_view, kView, "R", "Reset the view", "r"},
    {Action::toggle_straight_view, kView, "V", "Straight view, perspective", "v"},
    {Action::show_as_recorded,
     kView,
     "B, held",
     "Depth as recorded, before cleaning",
     "",
     {GLFW_KEY_B}},
    {Action::next_paint, kView, "D", "Colour of the video, clay, colours of the depth", "d"},
    {Action::toggle_panes, kView, "K", "Colour and depth as pictures above the relief", "k"},
    {Action::toggle_ruler, kView, "N", "Ruler between two clicks on the relief; end it", "n"},
    {Action::toggle_statistics, kView, "I", "Statistics over the relief", "i"},
    on_control(
        {Action::copy_view, kView, "Ctrl+C", "Copy where the view is from", "", {GLFW_KEY_C}}),
    on_control({Action::paste_view, kView, "Ctrl+V", "Take the copied view", "", {GLFW_KEY_V}}),
    {Action::toggle_panels, kView, "Tab", "Hide the panels, show them", "", {GLFW_KEY_TAB}},
    while_typing(
        {Action::toggle_full_screen, kView, "F11", "Full screen on, off", "", {GLFW_KEY_F11}}),
    with_control({Action::open_file, kProgram, "Ctrl+O", "Open files", "", {GLFW_KEY_O}}),
    with_control({Action::next_file,
                  kProgram,
                  "Ctrl+Page down",
                  "The next file of the folder",
                  "",
                  {GLFW_KEY_PAGE_DOWN}}),
    with_control({Action::previous_file,
                  kProgram,
                  "Ctrl+Page up",
                  "The file before it",
                  "",
                  {GLFW_KEY_PAGE_UP}}),
    // Before those without Shift, which take the same keys.
    while_typing(with_shift({Action::take_screenshot_of_relief,
                             kProgram,
                             "Shift+F12",
                             "Save a picture without panels",
                             "",
                             {GLFW_KEY_F12}})),
    while_typing(with_shift({Action::take_clip_of_relief,
                             kProgram,
                             "Shift+F9",
                             "Save a clip without panels, end it",
                             "",
                             {GLFW_KEY_F9}})),
    while_typing({Action::take_screenshot,
                  kProgram,
                  "S or F12",
                  "Save a picture, by default into the current folder",
                  "s",
                  {GLFW_KEY_F12}}),
    while_typing(
        {Action::take_clip, kProgram, "F9", "Save a clip (MP4), end it", "", {GLFW_KEY_F9}}),
    while_typing({Action::toggle_help, kProgram, "? or F1", "This sheet", "?h", {GLFW_KEY_F1}}),
    while_typing({Action::close_topmost,
                  kProgram,
                  "Esc",
                  "Close this sheet or a message",
                  "",
                  {GLFW_KEY_ESCAPE}}),
    {Action::quit, kProgram, "Q or Ctrl+Q", "Quit", "q"},
    with_control({Action::quit, kProgram, "", "", "", {GLFW_KEY_Q}}),
};

unsigned lower_case(unsigned c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

}  // namespace

std::span<const KeyBinding> key_bindings() {
    return kBindings;
}

int held_key(Action action) {
    const auto* const found =
        std::find_if(std::begin(kBindings), std::end(kBindings),
                     [action](const KeyBinding& binding) { return binding.action == action; });
    return found->keys[0];
}

std::optional<Action> action_of_character(unsigned character, bool repeated) {
    const unsigned wanted = lower_case(character);
    if (wanted > 0x7e) return {};
    for (const KeyBinding& binding : kBindings) {
        if (binding.characters.find(static_cast<char>(wanted)) != std::string_view::npos) {
            return repeated && !binding.repeats ? std::nullopt : std::optional(binding.action);
        }
    }
    return {};
}

std::optional<Action> action_of_key(int key, bool control, bool typing, bool repeated, bool shift) {
    for (const KeyBinding& binding : kBindings) {
        const bool bound = std::find(std::begin(binding.keys), std::end(binding.keys), key) !=
                           std::end(binding.keys);
        if (bound && key != 0 && binding.with_control == control &&
            (shift || !binding.with_shift) && (binding.while_typing || !typing) &&
            (binding.repeats || !repeated)) {
            return binding.action;
        }
    }
    return {};
}

std::optional<ListKey> list_key(int key) {
    if (key == GLFW_KEY_UP) return ListKey::up;
    if (key == GLFW_KEY_DOWN) return ListKey::down;
    if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) return ListKey::take;
    return std::nullopt;
}

}  // namespace dibhr
