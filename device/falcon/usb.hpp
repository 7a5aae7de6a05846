// The Falcons on the USB and the FT232R in each: requests and packets (README.md: USB identity,
// FTDI requests, IN packets), owners of libusb's handles, its errors as sentences for the user.
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

struct libusb_context;
struct libusb_device_handle;

namespace dibhr::falcon {

/// Not the 6001 of a plain FTDI adapter.
inline constexpr std::uint16_t kVendor = 0x0403;
inline constexpr std::uint16_t kProduct = 0xcb48;
inline constexpr int kInterface = 0;
inline constexpr std::uint8_t kOutEndpoint = 0x02;
inline constexpr std::uint8_t kInEndpoint = 0x81;
inline constexpr std::size_t kUsbPacketBytes = 64;
inline constexpr std::size_t kStatusBytes = 2;
inline constexpr std::size_t kMostDataBytes = kUsbPacketBytes - kStatusBytes;

/// A vendor request from the host to the chip: type 0x40, no data.
struct FtdiRequest {
    std::uint8_t request{0};
    std::uint16_t value{0};
    std::uint16_t index{0};
};

/// Which of the two empties which queue is disputed: always send both.
inline constexpr FtdiRequest kPurgeOne{0, 1};
inline constexpr FtdiRequest kPurgeOther{0, 2};

/// High byte: which line; low byte: its value.
inline constexpr FtdiRequest kDtrHigh{1, 0x0101};
inline constexpr FtdiRequest kDtrLow{1, 0x0100};
inline constexpr FtdiRequest kRtsLow{1, 0x0200};

inline constexpr FtdiRequest kNoFlowControl{2, 0};

/// Divisors of 3 MHz: bits 0-13 the whole part, bits 14-15 and index bit 0 code the eighths.
inline constexpr FtdiRequest kBaud9600{3, 0x4138};       // / 312.5
inline constexpr FtdiRequest kBaud142857{3, 0x0015};     // / 21: "140000" of libnifalcon
inline constexpr FtdiRequest kBaud140351{3, 0x0015, 1};  // / 21.375: "140000" of libftdi and D2XX
inline constexpr FtdiRequest kBaud115200{3, 0x001a};     // / 26; untested as an upload's
inline constexpr FtdiRequest kBaud57600{3, 0xc034};      // / 52.125; untested
inline constexpr FtdiRequest kBaudRunTime{3, 0x0002};    // / 2 = 1 500 000

inline constexpr FtdiRequest kEightBitsNoParity{4, 0x0008};

/// The chip sends what it has as soon as the Falcon's '>' comes by (untried on a real one).
inline constexpr FtdiRequest kFlushOnReplyEnd{6, '>' | 0x100};
inline constexpr FtdiRequest kNoEventCharacter{6, 0};

/// How long the chip keeps a packet that is not full [ms].
inline constexpr FtdiRequest kLatencyUploading{9, 16};
inline constexpr FtdiRequest kLatencyRunTime{9, 1};
// While nobody needs a pose: a sixth of the empty packets. A reply still comes before the command
// is sent again.
inline constexpr FtdiRequest kLatencyWhilePaused{9, 6};

/// Requests with an answer: modem and line status, 2 bytes; the latency timer [ms], 1 byte.
inline constexpr std::uint8_t kReadModemStatus = 5;
inline constexpr std::uint8_t kReadLatencyTimer = 10;

/// Bits of the second status byte, the line's.
inline constexpr std::uint8_t kOverrun = 0x02;      // bytes were lost
inline constexpr std::uint8_t kParityError = 0x04;  // a byte is not what was sent
inline constexpr std::uint8_t kFramingError = 0x08;

/// The data of an IN transfer.
struct Payload {
    std::span<const std::uint8_t> bytes{};
    std::uint8_t line_errors{0};      ///< the error bits of all its packets
    std::uint32_t faulty_packets{0};  ///< number of packets with an error bit
};

/// Takes the two status bytes off every 64-byte packet of a transfer, in place. A packet without
/// data is normal: the latency timer ran out.
[[nodiscard]] Payload payload_of(std::span<std::uint8_t> transfer) noexcept;

/// An attached Falcon, identified without opening it.
struct AttachedFalcon {
    int bus{0};
    int address{0};
    std::string serial{};  ///< empty: could not be read

    bool operator==(const AttachedFalcon&) const = default;
};

/// "the Falcon SIM00001"; when the serial is not known, with its USB bus and address.
[[nodiscard]] std::string full_name_of(const AttachedFalcon& falcon);

/// The Falcon with this serial; when `serial` is empty, the first one.
[[nodiscard]] std::optional<AttachedFalcon> choose(std::span<const AttachedFalcon> attached,
                                                   const std::string& serial);

/// Why choose() found none, and what to do.
[[nodiscard]] std::string why_none(std::span<const AttachedFalcon> attached,
                                   const std::string& serial);

/// "A1, B2, one without a readable serial".
[[nodiscard]] std::string serials_of(std::span<const AttachedFalcon> attached);

/// A libusb error with a sentence for the user.
class UsbError : public DeviceError {
  public:
    UsbError(int code, const std::string& sentence) : DeviceError(sentence), code_(code) {}
    /// LIBUSB_ERROR_...
    [[nodiscard]] int code() const noexcept { return code_; }
    /// Not attached any more.
    [[nodiscard]] bool unplugged() const noexcept;

  private:
    int code_;
};

/// The error for a LIBUSB_ERROR_... that came while using `falcon`: its meaning and what to do.
[[nodiscard]] UsbError usb_error(int code, const AttachedFalcon& falcon);

class UsbContext {
  public:
    /// Throws UsbError when libusb cannot be initialised.
    UsbContext();
    [[nodiscard]] libusb_context* get() const noexcept { return context_.get(); }

  private:
    struct Close {
        void operator()(libusb_context* context) const noexcept;
    };
    std::unique_ptr<libusb_context, Close> context_{};
};

/// Every 0403:cb48, in the order of serials. Opens only those whose serial the system does not
/// know. Throws UsbError.
[[nodiscard]] std::vector<AttachedFalcon> attached_falcons(const UsbContext& usb);

/// The string descriptor with this index; empty when it cannot be read.
[[nodiscard]] std::string text_at(libusb_device_handle* handle, std::uint8_t index);

/// A Falcon's serial port, opened and claimed. A kernel driver is detached meanwhile, and attached
/// again at the end. Used by one thread. Every call throws UsbError when the USB fails.
class FtdiPort {
  public:
    FtdiPort(const UsbContext& usb, const AttachedFalcon& which);
    ~FtdiPort();
    FtdiPort(const FtdiPort&) = delete;
    FtdiPort& operator=(const FtdiPort&) = delete;

    void request(const FtdiRequest& request);
    /// A request with an answer, read into `answer`.
    void ask(std::uint8_t request, std::span<std::uint8_t> answer);
    /// Empties both queues of the chip.
    void purge();
    /// Writes all of `bytes`; waits at most `limit`.
    void write(std::span<const std::uint8_t> bytes,
               std::chrono::milliseconds limit = std::chrono::seconds(1));
    /// Reads one IN packet within `limit`, at least 1 ms; no bytes when none came. Valid until the
    /// next read.
    [[nodiscard]] Payload read(std::chrono::milliseconds limit);
    /// After a stall: lets both endpoints transfer again. Ignores errors.
    void clear_stall() noexcept;

    [[nodiscard]] libusb_device_handle* handle() const noexcept { return handle_.get(); }
    [[nodiscard]] const AttachedFalcon& falcon() const noexcept { return falcon_; }
    /// Descriptor of the usbfs file that libusb has opened; -1: none. Only one port may be open
    /// with `usb`.
    [[nodiscard]] int descriptor(const UsbContext& usb) const noexcept;

  private:
    struct Close {
        void operator()(libusb_device_handle* handle) const noexcept;
    };

    AttachedFalcon falcon_{};
    std::unique_ptr<libusb_device_handle, Close> handle_{};
    std::vector<std::uint8_t> packet_{};
};

}  // namespace dibhr::falcon
