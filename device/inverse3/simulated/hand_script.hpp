// Moves the simulated hand and device by lines of text, typed or from a script.
#pragma once

#include <string>

#include "device/inverse3/simulated/service.hpp"

namespace dibhr::inverse3::simulated {

/// The commands, for the user.
inline constexpr const char* kHandCommands =
    "Type: hand X Y Z SECONDS (mm from the middle of the box: right, forward, up)\n"
    "      button A|B|C|HOME down|up\n"
    "      calibrated|power|in_use on|off\n"
    "      plug, unplug, silence on|off, drop\n"
    "      state (where the hand is, and what pushes it back)\n";

/// Runs one line after the other; the hand keeps moving meanwhile.
class HandScript {
  public:
    /// `service` must outlive this object.
    explicit HandScript(Service& service);
    /// Runs one line and returns the answer to print: empty, or an error for an unknown command.
    [[nodiscard]] std::string run_line(const std::string& line);

  private:
    Service& service_;
};

}  // namespace dibhr::inverse3::simulated
