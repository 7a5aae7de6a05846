// What the FT232R tells when it is asked (../README.md, FTDI requests).
#pragma once

#include <array>
#include <cstdint>

#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

/// [ms] Throws UsbError.
[[nodiscard]] int read_latency_timer(FtdiPort& port);

/// Modem and line status. Throws UsbError.
[[nodiscard]] std::array<std::uint8_t, 2> read_modem_status(FtdiPort& port);

}  // namespace dibhr::falcon
