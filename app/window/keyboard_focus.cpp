// The way of the keyboard through the panels.
#include "app/window/keyboard_focus.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace dibhr {

namespace {

constexpr int kPage = 8;        // items
constexpr int kFastSteps = 10;  // with Shift

bool takes_text(ItemKeys keys) {
    return keys == ItemKeys::type || keys == ItemKeys::slide || keys == ItemKeys::line;
}

bool is_enter(int key) {
    return key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER;
}

bool moves_in_panels(int key) {
    constexpr int kKeys[] = {GLFW_KEY_TAB,     GLFW_KEY_SPACE,    GLFW_KEY_UP,   GLFW_KEY_DOWN,
                             GLFW_KEY_LEFT,    GLFW_KEY_RIGHT,    GLFW_KEY_HOME, GLFW_KEY_END,
                             GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN};
    return is_enter(key) || std::ranges::find(kKeys, key) != std::end(kKeys);
}

/// Whether it is a card or a list, and not a panel or bar, which stays.
bool is_in_front(const ImGuiWindow& window) {
    return (window.Flags & ImGuiWindowFlags_NoBringToFrontOnFocus) == 0;
}

/// The window that must be answered first; null: none.
const ImGuiWindow* open_popup() {
    const ImVector<ImGuiPopupData>& popups = ImGui::GetCurrentContext()->OpenPopupStack;
    return popups.empty() ? nullptr : popups.back().Window;
}

}  // namespace

KeyboardFocus* KeyboardFocus::current() {
    return static_cast<KeyboardFocus*>(ImGui::GetIO().UserData);
}

void KeyboardFocus::go_to_area(int by) {
    on_ = true;
    area_moves_ += by;
    moved_ = true;
}

void KeyboardFocus::leave() {
    *this = {};
}

bool KeyboardFocus::take(const KeyPress& press, bool typing) {
    const bool tab = press.key == GLFW_KEY_TAB && !press.control;
    if (typing && tab && !on_) {  // on from the text that a click began
        on_ = true;
        id_ = ImGui::GetCurrentContext()->ActiveId;
    }
    if (!on_ || press.control || (typing ? !tab : !moves_in_panels(press.key))) return false;
    keys_.push_back(press);
    return true;
}

void KeyboardFocus::begin() {
    items_.clear();
    described_ = {};
    const ImGuiIO& io = ImGui::GetIO();
    if (on_ && std::any_of(std::begin(io.MouseClicked), std::end(io.MouseClicked),
                           [](bool clicked) { return clicked; }))
        leave();
}

bool KeyboardFocus::add(ItemKeys keys, bool preferred) {
    return add(keys, ImGui::GetItemID(), ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
               preferred);
}

bool KeyboardFocus::add(ItemKeys keys, ImGuiID id, ImVec2 low, ImVec2 high, bool preferred) {
    if (!on_) return false;
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if ((context.CurrentItemFlags & ImGuiItemFlags_Disabled) != 0) return false;
    ImGuiWindow* const window = context.CurrentWindow;
    items_.push_back({id, keys, low, high, window, window->RootWindow, preferred});
    return has(id);
}

void KeyboardFocus::describe(ItemWords words) {
    described_ = std::move(words);
}

void KeyboardFocus::end(float scale) {
    steps_ = {};
    if (!on_) return;
    moved_ = false;
    words_ = described_;
    go_to_new_area();
    follow_typing();
    find_again();
    if (area_moves_ != 0) go_by_areas(std::exchange(area_moves_, 0));
    while (on_ && !keys_.empty() && !items_.empty()) {
        const KeyPress key = keys_.front();
        keys_.erase(keys_.begin());
        if (!carry_out(key)) break;
    }
    if (on_) draw_frame(scale);
}

void KeyboardFocus::keep_popup_only() {
    const ImGuiWindow* const popup = open_popup();
    if (popup == nullptr) return;
    std::erase_if(items_, [popup](const Item& item) { return item.area != popup; });
}

/// A card or list that has opened above the others gets the keyboard, until it is closed.
void KeyboardFocus::go_to_new_area() {
    const std::vector<ImGuiWindow*> all = areas();
    keep_popup_only();
    for (ImGuiWindow* const area : all) {
        const bool known = std::ranges::find(seen_, area) != seen_.end();
        if (known || !is_in_front(*area) || seen_.empty() || id_ == 0 || !holds(area)) continue;
        go_to(first_in(area));
    }
    seen_ = all;
}

/// A text that takes the keyboard by itself, as that of a dialog does, has it here, too.
void KeyboardFocus::follow_typing() {
    const ImGuiID active = ImGui::GetCurrentContext()->ActiveId;
    const auto typed = std::ranges::find(items_, active, &Item::id);
    if (active != 0 && typed != items_.end() && takes_text(typed->keys)) id_ = active;
}

/// Where the item is now; if it is gone, to the one from which the keyboard came, or else to the
/// one before it.
void KeyboardFocus::find_again() {
    if (items_.empty() || id_ == 0) return;
    const auto index_of = [this](ImGuiID id) {
        const auto found = std::ranges::find(items_, id, &Item::id);
        return static_cast<std::size_t>(found - items_.begin());
    };
    std::size_t at = index_of(id_);
    if (at < items_.size()) {
        at_ = at;
        area_ = items_[at].area;
        return;
    }
    const bool area_is_gone = !back_.empty() || !holds(area_);
    while (!back_.empty()) {
        const Place place = back_.back();
        back_.pop_back();
        at = index_of(place.id);
        at_ = place.at;
        if (at < items_.size()) return go_to(at);
    }
    if (area_is_gone) return leave();
    go_to(std::min(at_ > 0 ? at_ - 1 : 0, items_.size() - 1));
}

bool KeyboardFocus::holds(const ImGuiWindow* area) const {
    return std::ranges::find(items_, area, &Item::area) != items_.end();
}

/// False: the next keys wait for the next picture.
bool KeyboardFocus::carry_out(const KeyPress& key) {
    const ItemKeys keys = id_ != 0 ? items_[at_].keys : ItemKeys::press;
    const bool slides = keys == ItemKeys::slide || keys == ItemKeys::turn;
    const bool lists = keys == ItemKeys::list;
    const int step = key.shift ? kFastSteps : 1;
    switch (key.key) {
        case GLFW_KEY_TAB:
            go_by(key.shift ? -1 : 1, true);
            return !takes_text(items_[at_].keys);
        case GLFW_KEY_UP:
        case GLFW_KEY_DOWN: {
            const int by = key.key == GLFW_KEY_DOWN ? 1 : -1;
            if (lists) steps_.down += by * step;
            if (!lists) go_by(by, false);
            return !lists;
        }
        case GLFW_KEY_LEFT:
        case GLFW_KEY_RIGHT: {
            const int by = key.key == GLFW_KEY_RIGHT ? 1 : -1;
            if (slides) steps_.across += by * step;
            if (!slides && !lists) go_by(by, false);
            return !slides;
        }
        case GLFW_KEY_PAGE_UP:
        case GLFW_KEY_PAGE_DOWN: {
            const int by = key.key == GLFW_KEY_PAGE_DOWN ? kPage : -kPage;
            if (lists) steps_.down += by;
            if (!lists) go_by(by, false);
            return !lists;
        }
        case GLFW_KEY_HOME:
            go_to(first_in(items_[at_].area));
            return true;
        case GLFW_KEY_END:
            while (at_ + 1 < items_.size() && items_[at_ + 1].area == items_[at_].area) ++at_;
            go_to(at_);
            return true;
        default:
            if (lists && is_enter(key.key)) steps_.enter = true;
            if (!lists && keys != ItemKeys::turn && id_ != 0) activate(keys);
            return false;
    }
}

void KeyboardFocus::activate(ItemKeys keys) {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.NavNextActivateId = id_;
    context.NavNextActivateFlags =
        takes_text(keys) ? ImGuiActivateFlags_PreferInput : ImGuiActivateFlags_None;
    moved_ = true;
}

void KeyboardFocus::go_to(std::size_t at) {
    const Item& item = items_[at];
    const bool comes_back = area_ != nullptr && item.area != area_ && is_in_front(*item.area);
    if (comes_back) back_.push_back({id_, at_});
    at_ = at;
    id_ = item.id;
    area_ = item.area;
    moved_ = true;
    if (ImGui::GetCurrentContext()->ActiveId != item.id) ImGui::ClearActiveID();
    const float around = ImGui::GetFrameHeight();
    ImGui::ScrollToRectEx(item.window,
                          {item.low.x, item.low.y - around, item.high.x, item.high.y + around});
    if (item.keys == ItemKeys::line) activate(item.keys);
}

/// Tab goes around: in a window with a title, which waits for an answer, in that alone.
void KeyboardFocus::go_by(int by, bool around) {
    if (id_ == 0) return go_to(0);
    const bool within = (area_->Flags & ImGuiWindowFlags_NoTitleBar) == 0;
    const auto is_of_way = [&](const Item& item) { return !within || item.area == area_; };
    const auto first = std::ranges::find_if(items_, is_of_way);
    const int begin = static_cast<int>(first - items_.begin());
    const int count = static_cast<int>(std::ranges::count_if(items_, is_of_way));
    const int next = static_cast<int>(at_) - begin + by;
    const int to = around ? (next + count) % count : std::clamp(next, 0, count - 1);
    go_to(static_cast<std::size_t>(begin + to));
}

void KeyboardFocus::go_by_areas(int by) {
    const std::vector<ImGuiWindow*> all = areas();
    if (all.empty()) return leave();
    const int count = static_cast<int>(all.size());
    const auto here = id_ != 0 ? std::ranges::find(all, items_[at_].area) : all.end();
    const int from = here != all.end() ? static_cast<int>(here - all.begin()) : by > 0 ? -1 : count;
    const int next = from + by;
    if ((next < 0 || next >= count) && open_popup() == nullptr) return leave();
    go_to(first_in(all[static_cast<std::size_t>(std::clamp(next, 0, count - 1))]));
}

std::vector<ImGuiWindow*> KeyboardFocus::areas() const {
    std::vector<ImGuiWindow*> found;
    for (const Item& item : items_)
        if (std::ranges::find(found, item.area) == found.end()) found.push_back(item.area);
    return found;
}

/// The preferred item, or else the first one.
std::size_t KeyboardFocus::first_in(const ImGuiWindow* area) const {
    std::size_t first = items_.size();
    for (std::size_t k = 0; k < items_.size(); ++k) {
        if (items_[k].area != area) continue;
        if (items_[k].preferred) return k;
        first = std::min(first, k);
    }
    return first;
}

/// A line in the colour of what is chosen, with a dark and a light edge: it is seen on every
/// ground.
void KeyboardFocus::draw_frame(float scale) const {
    if (id_ == 0 || at_ >= items_.size()) return;
    const Item& item = items_[at_];
    const float line = 2.0F * scale;
    const float gap = 1.0F * scale;
    ImRect seen = item.window->OuterRectClipped;
    seen.Expand(gap + line);
    seen.ClipWith(item.area->OuterRectClipped);
    const float round = ImGui::GetStyle().FrameRounding + gap;
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.PushClipRect(seen.Min, seen.Max);
    const auto frame = [&](float out, float thick, ImU32 colour) {
        list.AddRect({item.low.x - out, item.low.y - out}, {item.high.x + out, item.high.y + out},
                     colour, round + out, 0, thick);
    };
    frame(gap, line + 2.0F * scale, ImGui::GetColorU32(ImGuiCol_WindowBg));
    frame(gap, line, ImGui::GetColorU32(ImGuiCol_CheckMark));
    list.PopClipRect();
}

}  // namespace dibhr
