// The fields and the queue of ImGui's own.
#include "app/window/gui_input.hpp"

#include <imgui_internal.h>

#include <algorithm>

namespace dibhr {

#if IMGUI_VERSION_NUM < 18700

LingeringKeys::LingeringKeys(std::span<const KeyPress> pressed) {
    bool* const down = ImGui::GetIO().KeysDown;
    constexpr int kKeys = IM_ARRAYSIZE(ImGuiIO::KeysDown);
    for (const KeyPress& press : pressed) {
        if (press.key < 0 || press.key >= kKeys || down[press.key]) continue;
        down[press.key] = true;
        keys_.push_back(press.key);
    }
}

LingeringKeys::~LingeringKeys() {
    for (const int key : keys_) ImGui::GetIO().KeysDown[key] = false;
}

bool missed_control(const WindowInput& input) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl || io.KeyShift || io.KeyAlt || io.KeySuper) return false;
    const auto chord = std::ranges::find_if(input.keys, &KeyPress::control);
    if (chord == input.keys.end()) return false;
    // Behind it characters alone: a key would act with Control down.
    const auto keys_before = static_cast<std::size_t>(chord - input.keys.begin());
    const auto keys_behind = input.keys.size() - keys_before - 1;
    return input.characters.size() >= keys_behind &&
           std::ranges::all_of(input.characters, [keys_before](const TypedCharacter& typed) {
               return typed.keys > keys_before + 1;
           });
}

void set_control(bool down) {
    ImGui::GetIO().KeyCtrl = down;
}

void drop_tabs() {}  // ImGui does not know the key

std::vector<unsigned> take_characters() {
    ImVector<ImWchar>& queue = ImGui::GetIO().InputQueueCharacters;
    std::vector<unsigned> taken(queue.begin(), queue.end());
    queue.clear();
    return taken;
}

void scale_pointer(ImVec2 pixels, int /*first*/) {
    ImVec2& place = ImGui::GetIO().MousePos;
    if (ImGui::IsMousePosValid(&place)) place = {place.x * pixels.x, place.y * pixels.y};
}

int queued_events() {
    return 0;
}

#else

namespace {

ImVector<ImGuiInputEvent>& queue() {
    return ImGui::GetCurrentContext()->InputEventsQueue;
}

template <typename Is>
void drop_events(const Is& is) {
    queue().erase(std::remove_if(queue().begin(), queue().end(), is), queue().end());
}

}  // namespace

LingeringKeys::LingeringKeys(std::span<const KeyPress> /*pressed*/) {}

LingeringKeys::~LingeringKeys() = default;

bool missed_control(const WindowInput& /*input*/) {
    return false;
}

void set_control(bool /*down*/) {}

void drop_tabs() {
    drop_events([](const ImGuiInputEvent& event) {
        return event.Type == ImGuiInputEventType_Key && event.Key.Key == ImGuiKey_Tab;
    });
}

std::vector<unsigned> take_characters() {
    const auto is_text = [](const ImGuiInputEvent& event) {
        return event.Type == ImGuiInputEventType_Text;
    };
    std::vector<unsigned> taken;
    for (const ImGuiInputEvent& event : queue())
        if (is_text(event)) taken.push_back(event.Text.Char);
    drop_events(is_text);
    return taken;
}

void scale_pointer(ImVec2 pixels, int first) {
    for (int k = first; k < queue().Size; ++k) {
        ImGuiInputEvent& event = queue()[k];
        if (event.Type != ImGuiInputEventType_MousePos) continue;
        const ImVec2 place(event.MousePos.PosX, event.MousePos.PosY);
        if (!ImGui::IsMousePosValid(&place)) continue;
        event.MousePos.PosX *= pixels.x;
        event.MousePos.PosY *= pixels.y;
    }
}

int queued_events() {
    return queue().Size;
}

#endif

}  // namespace dibhr
