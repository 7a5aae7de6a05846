// Commands in words for a simulated Falcon, for people and for tests outside of its process.
#pragma once

#include <string>

#include "tests/device/falcon/usbfs_unit.hpp"

namespace dibhr::test::falcon {

inline constexpr const char* kUnitCommands =
    R"(  hand X Y Z [SECONDS]  after its way so far the hand goes there, mm; at once without SECONDS
  place X Y Z           hand and grip are there at once, mm
  press BITS            buttons: 1 plus, 2 forward, 4 centre, 8 minus; their sum for several
  home                  all three axes are homed
  firmware              it runs, as another program left it
  power on|off          of the motor controller
  hold MS               how long the motors hold a command, ms; 0: for ever
  realtime on|off       whether the serial line and USB frames take their time
  fault NAME NUMBER     a member of Faults (faults.hpp)
  refuse ERRNO          opening fails with this number; 0: it does not
  driver NAME|none      bound by the kernel
  claimed yes|no        by another program
  state                 "stage running homed 7 ...": pairs of names and values; mm and N
)";

/// Does one line of kUnitCommands; answers "ok", the state, or "error: " and why, in one line.
[[nodiscard]] std::string perform(UsbfsUnit& unit, const std::string& line);

}  // namespace dibhr::test::falcon
