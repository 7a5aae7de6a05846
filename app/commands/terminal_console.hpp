// The guide of a device check on a terminal: plain lines and answers; any key ends a force.
#pragma once

#include <memory>

#include "device/hand/check/console.hpp"

namespace dibhr {

/// Reads standard input and writes standard output. While the guide exists, Ctrl+C requests to
/// quit, and Ctrl+Z does not stop the program, which may be applying a force. Create it before any
/// thread. Input that is no terminal is read line by line; only a "q" in it ends a force.
[[nodiscard]] std::unique_ptr<CheckConsole> make_terminal_console();

}  // namespace dibhr
