// Whether another window lies over all of the program's: so a screen lock hides it, which takes no
// keyboard away and unmaps nothing.
#pragma once

namespace dibhr {

/// Asks the X server at the middle of a mapped window of that size [px] and of its quarters. False
/// under another display server, which takes the keyboard away where it hides a window.
[[nodiscard]] bool is_covered(unsigned long x11_window, int width, int height);

}  // namespace dibhr
