// The Falcons on the USB, libusb's context and handles with owners, its errors in plain sentences.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "device/falcon/ftdi.hpp"

struct libusb_context;
struct libusb_device_handle;

namespace dibhr::falcon {

/// As it can be named without opening it.
struct AttachedFalcon {
    int bus{0};
    int address{0};
    std::string serial{};  ///< empty: could not be read

    bool operator==(const AttachedFalcon&) const = default;
};

/// "the Falcon SIM00001", or where it is plugged in when its serial is not known.
[[nodiscard]] std::string full_name_of(const AttachedFalcon& falcon);

/// The one with this serial; when it is empty, the first.
[[nodiscard]] std::optional<AttachedFalcon> choose(std::span<const AttachedFalcon> attached,
                                                   const std::string& serial);

/// Why choose() found none, and what to do.
[[nodiscard]] std::string why_none(std::span<const AttachedFalcon> attached,
                                   const std::string& serial);

/// "A1, B2, one without a readable serial".
[[nodiscard]] std::string serials_of(std::span<const AttachedFalcon> attached);

/// What libusb answered, and a sentence about it.
class UsbError : public DeviceError {
  public:
    UsbError(int code, const std::string& sentence) : DeviceError(sentence), code_(code) {}
    /// LIBUSB_ERROR_...
    [[nodiscard]] int code() const noexcept { return code_; }
    /// Not attached any more.
    [[nodiscard]] bool gone() const noexcept;

  private:
    int code_;
};

/// Of a LIBUSB_ERROR_... that came while using `falcon`: what it means, and what to do next.
[[nodiscard]] UsbError usb_error(int code, const AttachedFalcon& falcon);

class UsbContext {
  public:
    /// Throws UsbError when the USB cannot be looked at.
    UsbContext();
    [[nodiscard]] libusb_context* get() const noexcept { return context_.get(); }

  private:
    struct Close {
        void operator()(libusb_context* context) const noexcept;
    };
    std::unique_ptr<libusb_context, Close> context_{};
};

/// Every 0403:cb48, in the order of serials; opens none whose serial the system knows. Throws
/// UsbError.
[[nodiscard]] std::vector<AttachedFalcon> attached_falcons(const UsbContext& usb);

/// A Falcon's serial port, opened and claimed; whatever kernel driver held it has let go and gets
/// it back. Used by one thread. Every call throws UsbError when the USB fails.
class FtdiPort {
  public:
    FtdiPort(const UsbContext& usb, const AttachedFalcon& which);
    ~FtdiPort();
    FtdiPort(const FtdiPort&) = delete;
    FtdiPort& operator=(const FtdiPort&) = delete;

    void request(const FtdiRequest& request);
    /// A request with an answer, whose bytes it fills.
    void ask(std::uint8_t request, std::span<std::uint8_t> answer);
    /// Both queues of the chip.
    void purge();
    /// All of `bytes`; waits at most `limit`.
    void write(std::span<const std::uint8_t> bytes,
               std::chrono::milliseconds limit = std::chrono::seconds(1));
    /// What one IN packet brings within `limit`, at least 1 ms; no bytes when none came. Valid
    /// until the next read.
    [[nodiscard]] Payload read(std::chrono::milliseconds limit);
    /// After a stall: both endpoints take transfers again. Reports nothing.
    void clear_stall() noexcept;

    [[nodiscard]] libusb_device_handle* handle() const noexcept { return handle_.get(); }
    [[nodiscard]] const AttachedFalcon& falcon() const noexcept { return falcon_; }

  private:
    struct Close {
        void operator()(libusb_device_handle* handle) const noexcept;
    };

    AttachedFalcon falcon_{};
    std::unique_ptr<libusb_device_handle, Close> handle_{};
    std::vector<std::uint8_t> packet_{};
};

}  // namespace dibhr::falcon
