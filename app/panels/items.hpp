// ImGui's items as the keyboard reaches them: each has its words, for those who do not see it.
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "app/window/keyboard_focus.hpp"

namespace dibhr::item {

/// The last item of ImGui is one that the keyboard reaches. `words` makes its words, and is called
/// only while it has the keyboard. True if it has it.
template <typename Words>
bool reach(ItemKeys keys, const Words& words, bool preferred = false) {
    KeyboardFocus* const focus = KeyboardFocus::current();
    if (focus == nullptr || !focus->add(keys, preferred)) return false;
    focus->describe(words());
    return true;
}

/// Whether the keyboard is in the panels; and whether the last item has it.
[[nodiscard]] bool keyboard_is_on();
[[nodiscard]] bool has_keyboard();
/// The steps of the arrow keys for the item that has the keyboard: call after reach() was true.
[[nodiscard]] KeyboardFocus::Steps steps();

// As ImGui's own. What follows "##" in a label is not part of its words.
bool button(const char* label, ImVec2 size = {0.0F, 0.0F});
bool small_button(const char* label);
bool checkbox(const char* label, bool* value);
bool radio_button(const char* label, int* chosen, int which);
bool selectable(const char* label, bool chosen = false);
bool invisible_button(const char* id, ImVec2 size, const std::string& label);
/// `label`: in words.
bool list_box(const char* id, const std::string& label, std::span<const char* const> names,
              int& chosen);

}  // namespace dibhr::item
