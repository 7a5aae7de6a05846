// What is done when the X server goes away; a file of its own, since Xlib's header defines plain
// words as macros.
#pragma once

#include <functional>

namespace dibhr {

/// From here on `act` is called by the thread that notices that the X server has gone, within the
/// call that noticed it: it must not return, nor use the display. It outlives the display. Does
/// nothing under another display server.
void when_display_goes(const std::function<void()>& act);

/// The socket of the X server, which hangs up when it goes; -1 under another display server. For
/// the thread that made the window.
[[nodiscard]] int display_connection();

}  // namespace dibhr
