// The input that ImGui has not read yet, as its versions have it: before 1.87 the states of keys
// and pointer and the characters since the last picture, then a queue of events.
#pragma once

#include <imgui.h>

#include <span>
#include <vector>

#include "app/window/window.hpp"

namespace dibhr {

/// Keys that ImGui sees as down during this object's life. Without a queue it would miss a key
/// released again since the last picture.
class LingeringKeys {
  public:
    explicit LingeringKeys(std::span<const KeyPress> pressed);
    ~LingeringKeys();
    LingeringKeys(const LingeringKeys&) = delete;
    LingeringKeys& operator=(const LingeringKeys&) = delete;

  private:
    std::vector<int> keys_{};
};

/// The focus moves by Tab, not ImGui.
void drop_tabs();

/// Takes out the characters, which ImGui will not read.
[[nodiscard]] std::vector<unsigned> take_characters();

/// Whether Control and a key came and went since the last picture, before all characters. Without a
/// queue ImGui would miss Control.
[[nodiscard]] bool missed_control(const WindowInput& input);
/// As ImGui sees it; the same from the begin of a picture to its end.
void set_control(bool down);

/// The pointer from screen units, in which the backend has it, to pixels of the framebuffer.
/// `first`: the first event of the queue that is in screen units.
void scale_pointer(ImVec2 pixels, int first);

/// How many events there are in the queue.
[[nodiscard]] int queued_events();

}  // namespace dibhr
