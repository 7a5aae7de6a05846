// Is firmware already there? One question, one answer, before the run-time exchange begins
// (README.md, Probe).
#pragma once

#include <chrono>
#include <optional>
#include <stop_token>

#include "device/falcon/packet.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

/// Sends `command` and waits at most `limit` for a whole reply. Throws UsbError.
[[nodiscard]] std::optional<Reply> ask(FtdiPort& port, const Command& command,
                                       std::chrono::milliseconds limit);

/// Sets the chip to run-time speed and asks, without force, whether anything answers. Leaves DTR
/// and RTS alone, which could start the boot ROM. At most 0.4 s; false also when asked to stop.
/// Throws UsbError.
[[nodiscard]] bool answers(FtdiPort& port, const std::stop_token& stop);

/// Five packets without force, the last a Falcon gets; the chip is left without an event character,
/// as other programs expect it. Whatever the USB says, it goes on.
void leave_without_force(FtdiPort& port) noexcept;

}  // namespace dibhr::falcon
