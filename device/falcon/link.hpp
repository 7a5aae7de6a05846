// The run-time link to one Falcon: one read is always pending, one command is in flight, and the
// next one is sent only after a whole reply (README.md: IN packets, Reply rate).
#pragma once

#include <poll.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "device/falcon/packet.hpp"
#include "device/falcon/thread_buffers.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

struct LinkCounts {
    std::uint64_t resent{0};       ///< commands sent while the one before had no reply
    std::uint64_t line_errors{0};  ///< packets with overrun, parity or framing bits
    std::uint64_t bytes_discarded{0};
};

/// Used by one thread, which blocks only in wait(). The port must be at run-time speed, and must
/// not be used by others during the lifetime of the link.
class Link {
  public:
    using Clock = std::chrono::steady_clock;
    using Time = Clock::time_point;

    /// `wake` ends wait(). Throws UsbError.
    Link(const UsbContext& usb, FtdiPort& port, const Wake& wake);
    ~Link();  ///< cancels both transfers
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    /// Sleeps until a USB event, a signal of the wake, or `until`.
    void wait(Time until);

    /// The replies received in the last wait().
    [[nodiscard]] std::span<const Reply> replies() const noexcept { return replies_; }

    /// The last command was sent and has its reply.
    [[nodiscard]] bool idle() const noexcept;
    /// A command may be sent: the link is idle, or the last command has had no reply for 8 ms.
    [[nodiscard]] bool can_send(Time now) const noexcept;
    /// When a link that is not idle has to be checked: to send the command again, or to report that
    /// the Falcon is lost.
    [[nodiscard]] Time retry_at() const noexcept;
    /// Only when can_send().
    void send(const Packet& packet, Time now);

    /// Why the link has ended; a new one may be tried.
    [[nodiscard]] const std::optional<UsbError>& loss() const noexcept { return loss_; }
    [[nodiscard]] LinkCounts counts() const noexcept;

  private:
    struct Transfers;

    void look_up_descriptors();
    void lose(int code);
    void note_loss(int code) noexcept { lost_code_ = lost_code_ == 0 ? code : lost_code_; }
    /// The error after a second without a reply.
    [[nodiscard]] UsbError timeout_error(Time now) const;
    void take(std::span<std::uint8_t> packet);

    const UsbContext& usb_;
    const AttachedFalcon& falcon_;
    const Wake& wake_;
    std::unique_ptr<Transfers> transfers_;
    std::vector<pollfd> descriptors_{};  // that of the wake, then those of libusb
    std::atomic<bool> descriptors_changed_{true};

    ReplyStream stream_{};
    std::vector<Reply> replies_{};
    LinkCounts counts_{};
    bool awaits_reply_{false};
    Time sent_{};
    Time last_reply_at_{};  // time of the last whole reply, or of construction
    int lost_code_{0};      // of a transfer that failed in this wait; LIBUSB_ERROR_...
    std::optional<UsbError> loss_{};
};

}  // namespace dibhr::falcon
