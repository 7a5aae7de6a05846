// Items that the keyboard reaches.
#include "app/panels/items.hpp"

#include <imgui_internal.h>

#include <cstddef>

namespace dibhr::item {

namespace {

std::string visible_part(const char* label) {
    return {label, ImGui::FindRenderedTextEnd(label)};
}

/// After the item has acted: with its new value.
void describe(const char* label, const char* kind, const char* value = "") {
    reach(ItemKeys::press, [&] { return ItemWords{visible_part(label), kind, value}; });
}

}  // namespace

bool keyboard_is_on() {
    const KeyboardFocus* const focus = KeyboardFocus::current();
    return focus != nullptr && focus->on();
}

bool has_keyboard() {
    const KeyboardFocus* const focus = KeyboardFocus::current();
    return focus != nullptr && focus->has(ImGui::GetItemID());
}

KeyboardFocus::Steps steps() {
    const KeyboardFocus* const focus = KeyboardFocus::current();
    return focus != nullptr ? focus->steps() : KeyboardFocus::Steps{};
}

bool button(const char* label, ImVec2 size) {
    const bool pressed = ImGui::Button(label, size);
    describe(label, "button");
    return pressed;
}

bool small_button(const char* label) {
    const bool pressed = ImGui::SmallButton(label);
    describe(label, "button");
    return pressed;
}

bool checkbox(const char* label, bool* value) {
    const bool changed = ImGui::Checkbox(label, value);
    describe(label, "check box", *value ? "on" : "off");
    return changed;
}

bool radio_button(const char* label, int* chosen, int which) {
    const bool changed = ImGui::RadioButton(label, chosen, which);
    describe(label, "choice", *chosen == which ? "chosen" : "");
    return changed;
}

bool selectable(const char* label, bool chosen) {
    const bool pressed = ImGui::Selectable(label, chosen);
    reach(
        ItemKeys::press,
        [&] {
            return ItemWords{visible_part(label), "entry", chosen ? "chosen" : ""};
        },
        chosen);
    return pressed;
}

bool invisible_button(const char* id, ImVec2 size, const std::string& label) {
    const bool pressed = ImGui::InvisibleButton(id, size);
    reach(ItemKeys::press, [&] { return ItemWords{label, "button", {}}; });
    return pressed;
}

bool list_box(const char* id, const std::string& label, std::span<const char* const> names,
              int& chosen) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 high{low.x + ImGui::CalcItemWidth(), low.y + ImGui::GetFrameHeight()};
    const char* const shown = names[static_cast<std::size_t>(chosen)];
    KeyboardFocus* const focus = KeyboardFocus::current();
    if (focus != nullptr && focus->add(ItemKeys::press, ImGui::GetID(id), low, high))
        focus->describe({label, "list", shown});
    if (!ImGui::BeginCombo(id, shown)) return false;
    const int before = chosen;
    for (int k = 0; k < static_cast<int>(names.size()); ++k) {
        ImGui::PushID(k);
        if (selectable(names[static_cast<std::size_t>(k)], k == before)) chosen = k;
        if (k == before) ImGui::SetItemDefaultFocus();
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return chosen != before;
}

}  // namespace dibhr::item
