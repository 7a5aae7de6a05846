// From an open port to a Falcon that answers: asks it, and loads its firmware, with the echo
// checked byte by byte and tried again (README.md: Probe, Upload).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "core/error.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/guardian.hpp"

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
/// The same packet, for the guardian.
[[nodiscard]] Farewell farewell() noexcept;

/// The firmware did not get in; the sentence names the step that failed and what to do.
class UploadError : public DeviceError {
  public:
    using DeviceError::DeviceError;
};

/// A step of a try that has ended.
struct UploadStep {
    int number{1};         ///< of the try
    const char* name{""};  ///< "hello", "autobaud", "echo", "answer"
    bool done{false};
    FtdiRequest baud{};                     ///< at which this try's image goes in
    std::span<const std::uint8_t> heard{};  ///< what hello and autobaud brought, stray bytes too
};

struct UploadOptions {
    bool slower{false};  ///< 140 351 instead of 142 857 baud
    /// Called with the part that is in, 0 .. 1, and the try, 1 ..
    std::function<void(double, int)> tell{[](double, int) {}};
    /// Called after every step, for a log.
    std::function<void(const UploadStep&)> watch{[](const UploadStep&) {}};
};

/// Loads `image`, of which no byte is sent unless it passes fault_of_firmware(), and makes sure
/// that it answers. True when it does; false when asked to stop, which it does within 0.2 s. A
/// Falcon without power is told after 6.5 s; the longest way to fail, ten tries, takes some 20 s.
/// Throws UploadError or UsbError.
[[nodiscard]] bool upload(FtdiPort& port, std::span<const std::uint8_t> image,
                          const UploadOptions& options, const std::stop_token& stop);

enum class BroughtUp { answers, no_firmware, stopped };

/// Asks it; when nothing answers, loads `firmware`, if there is any. Throws UploadError or
/// UsbError.
[[nodiscard]] BroughtUp bring_up(FtdiPort& port, const FirmwareImage& firmware,
                                 const UploadOptions& options, const std::stop_token& stop);

/// What a person does when there is no firmware in `falcon` and no file to load.
[[nodiscard]] std::string firmware_is_wanted(const AttachedFalcon& falcon);

}  // namespace dibhr::falcon
