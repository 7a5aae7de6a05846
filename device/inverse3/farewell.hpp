// What the guardian says to the service when the program no longer can.
#pragma once

#include "device/hand/guardian.hpp"
#include "device/inverse3/order.hpp"

namespace dibhr::inverse3 {

/// A zero force for this device, as a whole frame of a WebSocket's client (RFC 6455, 5.2).
[[nodiscard]] Farewell farewell(const DeviceId& arm, ForceDialect dialect) noexcept;

}  // namespace dibhr::inverse3
