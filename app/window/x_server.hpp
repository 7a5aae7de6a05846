// Queries of the X server: whether the window is covered, and whether the server is lost. A file of
// its own, since Xlib's header defines plain words as macros.
#pragma once

#include <chrono>
#include <functional>

struct GLFWwindow;

namespace dibhr {

/// The X server's ID of the window; 0 under another display server.
[[nodiscard]] unsigned long x11_window_of(GLFWwindow* window);

/// Whether other windows cover this one. A screen lock does so: it neither takes the keyboard away
/// nor unmaps the window. Checks the middle of a mapped window of that size [px] and the middles of
/// its quarters. False under another display server: there a hidden window has no keyboard.
[[nodiscard]] bool is_covered(unsigned long x11_window, int width, int height);

/// Waits for events, for `descriptor` to become readable, or so long. Takes no event, so that
/// EventTimes finds them. False under another display server: it has not waited.
[[nodiscard]] bool wait_for_x_events(int descriptor, std::chrono::milliseconds at_most);

/// From now on the thread that notices the loss of the X server calls `act`, within the call that
/// noticed it. `act` must neither return nor use the display, and must outlive the display. Does
/// nothing under another display server.
void set_display_loss_handler(const std::function<void()>& act);

/// The socket of the X server; it hangs up when the server is lost. -1 under another display
/// server. Call it on the thread that made the window.
[[nodiscard]] int display_connection();

}  // namespace dibhr
