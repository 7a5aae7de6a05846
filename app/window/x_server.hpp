// What only the X server knows of the program's window: whether it is covered, and that the server
// goes away. A file of its own, since Xlib's header defines plain words as macros.
#pragma once

#include <functional>

struct GLFWwindow;

namespace dibhr {

/// The window as the X server knows it; 0 under another display server.
[[nodiscard]] unsigned long x11_window_of(GLFWwindow* window);

/// Whether another window lies over all of it: so a screen lock hides it, which takes no keyboard
/// away and unmaps nothing. Asks at the middle of a mapped window of that size [px] and of its
/// quarters. False under another display server, which takes the keyboard away where it hides a
/// window.
[[nodiscard]] bool is_covered(unsigned long x11_window, int width, int height);

/// From here on `act` is called by the thread that notices that the X server has gone, within the
/// call that noticed it: it must not return, nor use the display. It outlives the display. Does
/// nothing under another display server.
void when_display_goes(const std::function<void()>& act);

/// The socket of the X server, which hangs up when it goes; -1 under another display server. For
/// the thread that made the window.
[[nodiscard]] int display_connection();

}  // namespace dibhr
