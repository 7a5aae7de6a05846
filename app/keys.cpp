// The table of keys, and looking things up in it.
#include "app/keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>

namespace dibhr {

namespace {

constexpr KeyBinding kBindings[] = {
    {Action::toggle_force,
     "Touch",
     "F or F8",
     "Force off, force on again",
     "f",
     {GLFW_KEY_F8},
     false,
     true},
    {Action::play_or_pause, "Playback", "Space or P", "Play, pause", " p"},
    {Action::step_forward, "Playback", ".", "One frame forward", "."},
    {Action::step_back, "Playback", ",", "One frame back", ","},
    {Action::seek_forward, "Playback", "Right", "5 s forward", "", {GLFW_KEY_RIGHT}},
    {Action::seek_back, "Playback", "Left", "5 s back", "", {GLFW_KEY_LEFT}},
    {Action::go_to_start, "Playback", "Home", "To the start", "", {GLFW_KEY_HOME}},
    {Action::slower, "Playback", "[ or -", "Slower", "[-"},
    {Action::faster, "Playback", "] or +", "Faster", "]+="},
    {Action::toggle_loop, "Playback", "L", "Loop on, off", "l"},
    {Action::reset_view, "View", "R", "Reset the view", "r"},
    {Action::toggle_straight_view, "View", "V", "Straight view, perspective", "v"},
    {Action::toggle_panels, "View", "Tab", "Hide the panels, show them", "", {GLFW_KEY_TAB}},
    {Action::toggle_full_screen,
     "View",
     "F11",
     "Full screen on, off",
     "",
     {GLFW_KEY_F11},
     false,
     true},
    {Action::open_file, "Program", "Ctrl+O", "Open files", "", {GLFW_KEY_O}, true, true},
    {Action::take_screenshot,
     "Program",
     "S or F12",
     "Save a picture into the current folder",
     "s",
     {GLFW_KEY_F12},
     false,
     true},
    {Action::toggle_help, "Program", "? or F1", "This sheet", "?h", {GLFW_KEY_F1}, false, true},
    {Action::close_topmost,
     "Program",
     "Esc",
     "Close this sheet or a message",
     "",
     {GLFW_KEY_ESCAPE},
     false,
     true},
    {Action::quit, "Program", "Q or Ctrl+Q", "Quit", "q"},
    {Action::quit, "Program", "", "", "", {GLFW_KEY_Q}, true, true},
};

unsigned lower_case(unsigned c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

}  // namespace

std::span<const KeyBinding> key_bindings() {
    return kBindings;
}

std::optional<Action> action_of_character(unsigned character) {
    const unsigned wanted = lower_case(character);
    if (wanted > 0x7e) return {};
    for (const KeyBinding& binding : kBindings) {
        if (binding.characters.find(static_cast<char>(wanted)) != std::string_view::npos) {
            return binding.action;
        }
    }
    return {};
}

std::optional<Action> action_of_key(int key, bool control, bool typing) {
    for (const KeyBinding& binding : kBindings) {
        const bool bound = std::find(std::begin(binding.keys), std::end(binding.keys), key) !=
                           std::end(binding.keys);
        if (bound && key != 0 && binding.with_control == control &&
            (binding.while_typing || !typing)) {
            return binding.action;
        }
    }
    return {};
}

}  // namespace dibhr
