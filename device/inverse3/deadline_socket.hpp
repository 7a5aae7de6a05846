// A TCP connection to this machine whose calls all have a deadline.
#pragma once

#include <sys/uio.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <system_error>

#include "core/realtime/wake.hpp"

namespace dibhr::inverse3 {

/// Every call that waits ends at the deadline with std::errc::timed_out. Not copyable.
class DeadlineSocket {
  public:
    using Clock = std::chrono::steady_clock;
    using Time = Clock::time_point;

    DeadlineSocket() = default;
    ~DeadlineSocket() { close(); }
    DeadlineSocket(const DeadlineSocket&) = delete;
    DeadlineSocket& operator=(const DeadlineSocket&) = delete;

    void set_deadline(Time deadline) noexcept { deadline_ = deadline; }

    /// Connects to 127.0.0.1, with TCP_NODELAY.
    [[nodiscard]] std::error_code connect(std::uint16_t port) noexcept;
    /// Reads at least one byte; 0 with an empty code: the other end has closed.
    [[nodiscard]] std::size_t read(std::span<std::uint8_t> into, std::error_code& error) noexcept;
    /// Writes all parts in one system call: a program that dies leaves no partial frame, unless the
    /// socket's buffer is full.
    [[nodiscard]] std::size_t write(std::span<const iovec> parts, std::error_code& error) noexcept;
    /// Sets the frame that is sent once before the connection ends: before our close frame, or in
    /// close().
    void set_stop_packet(std::span<const std::uint8_t> frame) noexcept;
    void close() noexcept;

    /// -1: not connected.
    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

    /// Waits until bytes can be read (true), `wake` is signalled, or `until`. Also true when the
    /// other end has closed.
    [[nodiscard]] bool wait_readable(const Wake* wake, Time until) const noexcept;

  private:
    [[nodiscard]] std::error_code wait_for(short events) const noexcept;
    /// False: the frame was not sent as a whole.
    [[nodiscard]] bool send_stop_packet() noexcept;

    int descriptor_{-1};
    Time deadline_{Time::max()};
    std::array<std::uint8_t, 16384> came_{};  // received bytes, not yet read ...
    std::size_t from_{0};                     // ... from here
    std::size_t to_{0};                       // to here
    bool whole_{true};                        // no frame was written only in part
    std::array<std::uint8_t, 512> stop_packet_{};
    std::size_t stop_packet_size_{0};
};

}  // namespace dibhr::inverse3
