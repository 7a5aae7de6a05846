// The terminal as the person beside a device that is checked: plain lines, and any key lets go of a
// force.
#pragma once

#include <memory>

#include "device/hand/check/guide.hpp"

namespace dibhr {

/// Reads standard input and writes standard output. While it lives, Ctrl+C is a wish to quit, and
/// Ctrl+Z does not stop the program, which could be holding a force. Made before any thread is
/// started. Input that is no terminal answers line by line; of it, only a "q" ends a force.
[[nodiscard]] std::unique_ptr<CheckGuide> make_terminal_guide();

}  // namespace dibhr
