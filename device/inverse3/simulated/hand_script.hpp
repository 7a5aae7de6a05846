// The simulated hand and device, moved by lines of text: by hand or by a script.
#pragma once

#include <string>

#include "device/inverse3/simulated/service.hpp"

namespace dibhr::inverse3::simulated {

/// What can be typed, for people.
inline constexpr const char* kHandCommands =
    "Type: hand X Y Z SECONDS (mm from the middle of the box: right, forward, up)\n"
    "      button A|B|C|HOME down|up\n"
    "      calibrated|power|in_use on|off\n"
    "      plug, unplug, silence on|off, drop\n"
    "      state (where the hand is, and what pushes it back)\n";

/// Obeys one line after the other; the hand goes its way in the meantime.
class HandScript {
  public:
    /// `service` outlives it.
    explicit HandScript(Service& service);
    /// What is to be told; a line that is not understood says so, an empty one nothing.
    [[nodiscard]] std::string obey(const std::string& line);

  private:
    Service& service_;
};

}  // namespace dibhr::inverse3::simulated
