// The Touch that answers, for `dibhr devices` and `--device openhaptics`: no force is sent.
#pragma once

#include "device/openhaptics/driver_thread.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

/// Waits until the stage is known, at most for some seconds; `opening`: the library did not answer
/// in that time.
[[nodiscard]] Status known_status(const Driver& driver);

/// Opens the device, waits for its known_status(), and closes it.
[[nodiscard]] Status survey_device(const ConnectionOptions& options);

/// A device answers, whether or not it can be used.
[[nodiscard]] bool answers(const Status& status) noexcept;

/// A device is attached: it answers, another program uses it, or it is on the USB.
[[nodiscard]] bool is_attached(const Status& status, const ConnectionOptions& options);

}  // namespace dibhr::openhaptics
