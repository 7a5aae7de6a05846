// The table of keys, and looking things up in it.
#include "app/settings/keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>

namespace dibhr {

namespace {

constexpr KeyBinding kBindings[] = {
    {.action = Action::toggle_force,
     .group = "Touch",
     .shown = "F",
     .help = "Force off, force on again",
     .characters = "f"},
    {.action = Action::force_off,
     .group = "Touch",
     .shown = "F8",
     .help = "Force off, whatever it was",
     .keys = {GLFW_KEY_F8},
     .while_typing = true},
    {.action = Action::centre_workspace,
     .group = "Touch",
     .shown = "C",
     .help = "Centre the Falcon's hand in the image",
     .characters = "c"},
    {.action = Action::record,
     .group = "Touch",
     .shown = "Ctrl+R",
     .help = "Record what is touched, stop",
     .keys = {GLFW_KEY_R},
     .with_control = true,
     .while_typing = true},
    {.action = Action::mark,
     .group = "Touch",
     .shown = "M",
     .help = "Mark this moment of the recording",
     .characters = "m"},
    {.action = Action::play_or_pause,
     .group = "Playback",
     .shown = "Space or P",
     .help = "Play, pause",
     .characters = " p"},
    {.action = Action::step_forward,
     .group = "Playback",
     .shown = ".",
     .help = "One frame forward; in a replay, one tick",
     .characters = ".",
     .repeats = true},
    {.action = Action::step_back,
     .group = "Playback",
     .shown = ",",
     .help = "One frame back; in a replay, one tick",
     .characters = ",",
     .repeats = true},
    {.action = Action::seek_forward,
     .group = "Playback",
     .shown = "Right",
     .help = "5 s forward",
     .keys = {GLFW_KEY_RIGHT},
     .repeats = true},
    {.action = Action::seek_back,
     .group = "Playback",
     .shown = "Left",
     .help = "5 s back",
     .keys = {GLFW_KEY_LEFT},
     .repeats = true},
    {.action = Action::go_to_start,
     .group = "Playback",
     .shown = "Home",
     .help = "To the start",
     .keys = {GLFW_KEY_HOME}},
    {.action = Action::slower,
     .group = "Playback",
     .shown = "[ or -",
     .help = "Slower",
     .characters = "[-",
     .repeats = true},
    {.action = Action::faster,
     .group = "Playback",
     .shown = "] or +",
     .help = "Faster",
     .characters = "]+=",
     .repeats = true},
    {.action = Action::toggle_loop,
     .group = "Playback",
     .shown = "L",
     .help = "Loop on, off",
     .characters = "l"},
    {.action = Action::reset_view,
     .group = "View",
     .shown = "R",
     .help = "Reset the view",
     .characters = "r"},
    {.action = Action::toggle_straight_view,
     .group = "View",
     .shown = "V",
     .help = "Straight view, perspective",
     .characters = "v"},
    {.action = Action::toggle_panels,
     .group = "View",
     .shown = "Tab",
     .help = "Hide the panels, show them",
     .keys = {GLFW_KEY_TAB}},
    {.action = Action::toggle_full_screen,
     .group = "View",
     .shown = "F11",
     .help = "Full screen on, off",
     .keys = {GLFW_KEY_F11},
     .while_typing = true},
    {.action = Action::open_file,
     .group = "Program",
     .shown = "Ctrl+O",
     .help = "Open files",
     .keys = {GLFW_KEY_O},
     .with_control = true,
     .while_typing = true},
    {.action = Action::take_screenshot,
     .group = "Program",
     .shown = "S or F12",
     .help = "Save a picture into the current folder",
     .characters = "s",
     .keys = {GLFW_KEY_F12},
     .while_typing = true},
    {.action = Action::toggle_help,
     .group = "Program",
     .shown = "? or F1",
     .help = "This sheet",
     .characters = "?h",
     .keys = {GLFW_KEY_F1},
     .while_typing = true},
    {.action = Action::close_topmost,
     .group = "Program",
     .shown = "Esc",
     .help = "Close this sheet or a message",
     .keys = {GLFW_KEY_ESCAPE},
     .while_typing = true},
    {.action = Action::quit,
     .group = "Program",
     .shown = "Q or Ctrl+Q",
     .help = "Quit",
     .characters = "q"},
    {.action = Action::quit,
     .group = "Program",
     .shown = "",
     .help = "",
     .keys = {GLFW_KEY_Q},
     .with_control = true,
     .while_typing = true},
};

unsigned lower_case(unsigned c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

}  // namespace

std::span<const KeyBinding> key_bindings() {
    return kBindings;
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

std::optional<Action> action_of_key(int key, bool control, bool typing, bool repeated) {
    for (const KeyBinding& binding : kBindings) {
        const bool bound = std::find(std::begin(binding.keys), std::end(binding.keys), key) !=
                           std::end(binding.keys);
        if (bound && key != 0 && binding.with_control == control &&
            (binding.while_typing || !typing) && (binding.repeats || !repeated)) {
            return binding.action;
        }
    }
    return {};
}

}  // namespace dibhr
