// A TCP connection to this machine on which nothing waits longer than it may.
#pragma once

#include <sys/uio.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <system_error>

#include "device/hand/wake.hpp"

namespace dibhr::inverse3 {

/// Every call that waits ends at the deadline, with std::errc::timed_out. Not copied: one owner.
class DeadlineSocket {
  public:
    using Clock = std::chrono::steady_clock;
    using Time = Clock::time_point;

    DeadlineSocket() = default;
    ~DeadlineSocket() { close(); }
    DeadlineSocket(const DeadlineSocket&) = delete;
    DeadlineSocket& operator=(const DeadlineSocket&) = delete;

    void set_deadline(Time deadline) noexcept { deadline_ = deadline; }

    /// To 127.0.0.1; small messages leave at once.
    [[nodiscard]] std::error_code connect(std::uint16_t port) noexcept;
    /// At least one byte; 0 with an empty code: the other end has closed.
    [[nodiscard]] std::size_t read(std::span<std::uint8_t> into, std::error_code& error) noexcept;
    /// The parts one behind the other, in one call of the system: whoever dies leaves no half of
    /// them behind, unless there is no room.
    [[nodiscard]] std::size_t write(std::span<const iovec> parts, std::error_code& error) noexcept;
    /// Sent once before the connection ends, whoever ends it: before a close frame, or close().
    void set_last_words(std::span<const std::uint8_t> frame) noexcept;
    void close() noexcept;

    /// -1: not connected.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

    /// Until something can be read (true), `wake` is signalled, or `until`. Also true when the
    /// other end has gone.
    [[nodiscard]] bool wait_readable(const Wake* wake, Time until) const noexcept;

  private:
    [[nodiscard]] std::error_code wait_for(short events) const noexcept;
    /// False: they have not gone out whole.
    [[nodiscard]] bool say_last_words() noexcept;

    int descriptor_{-1};
    Time deadline_{Time::max()};
    std::array<std::uint8_t, 16384> came_{};  // and was not taken yet ...
    std::size_t from_{0};                     // ... from here
    std::size_t to_{0};                       // to here
    bool whole_{true};                        // all frames that were begun
    std::array<std::uint8_t, 512> last_words_{};
    std::size_t last_words_size_{0};
};

}  // namespace dibhr::inverse3
