// How a session's device is named: with how much of it was another's.
#pragma once

#include <string>

#include "core/session/session.hpp"

namespace dibhr {

/// The device that was asked for, and for how much of the time with a surface the mouse stood in:
/// "Novint Falcon 1234; the mouse stood in for 37.2 % of the ticks". At least 0.1 % if any.
[[nodiscard]] std::string device_text(const std::string& device, const HandTicks& hand);

}  // namespace dibhr
