// From an open port to a Falcon that answers: probes it and loads its firmware. The echo is checked
// byte by byte, and a failed upload is tried again (README.md: Probe, Upload).
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
[[nodiscard]] std::optional<Reply> request_reply(FtdiPort& port, const Command& command,
                                                 std::chrono::milliseconds limit);

/// Sets the chip to run-time speed and sends packets without force: whether a reply comes. Does not
/// touch DTR and RTS, which could start the boot ROM. At most 0.4 s; false also after a stop
/// request. Throws UsbError.
[[nodiscard]] bool answers(FtdiPort& port, const std::stop_token& stop);

/// Sends five packets without force, the last ones of a connection. Clears the event character of
/// the chip, as other programs expect it. USB errors are ignored.
void send_stop_packets(FtdiPort& port) noexcept;
/// The same packet, for the guardian.
[[nodiscard]] StopPacket stop_packet() noexcept;

/// The upload failed; the text names the failed step and what to do.
class UploadError : public DeviceError {
  public:
    using DeviceError::DeviceError;
};

/// A finished step of an upload's try.
struct UploadStep {
    int number{1};         ///< of the try
    const char* name{""};  ///< "hello", "autobaud", "echo", "answer"
    bool done{false};
    FtdiRequest baud{};  ///< baud rate of the image in this try
    std::span<const std::uint8_t>
        received{};  ///< bytes received in hello and autobaud, all of them
};

struct UploadOptions {
    bool slower{false};  ///< 140 351 instead of 142 857 baud
    /// Called with the loaded part, 0 .. 1, and the number of the try, from 1.
    std::function<void(double, int)> on_progress{[](double, int) {}};
    /// Called after every step, for a log.
    std::function<void(const UploadStep&)> on_step{[](const UploadStep&) {}};
};

/// Loads `image` and probes the Falcon. Sends no byte of an image that fails fault_of_firmware().
/// True when the Falcon answers; false within 0.2 s of a stop request. Fails after 6.5 s where the
/// Falcon has no power; ten failed tries take some 20 s. Throws UploadError or UsbError.
[[nodiscard]] bool upload(FtdiPort& port, std::span<const std::uint8_t> image,
                          const UploadOptions& options, const std::stop_token& stop);

enum class BroughtUp { answers, no_firmware, stopped };

/// Probes the Falcon; when it does not answer, loads `firmware`, if not empty. Throws UploadError
/// or UsbError.
[[nodiscard]] BroughtUp bring_up(FtdiPort& port, const FirmwareImage& firmware,
                                 const UploadOptions& options, const std::stop_token& stop);

/// What the user has to do when `falcon` has no firmware and there is no file to load.
[[nodiscard]] std::string missing_firmware_advice(const AttachedFalcon& falcon);

}  // namespace dibhr::falcon
