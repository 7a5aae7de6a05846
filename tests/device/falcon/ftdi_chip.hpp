// The FT232R as the host sees it: vendor requests, status bytes, latency timer
// (device/falcon/README.md: FTDI requests, IN packets).
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "tests/device/falcon/moment.hpp"

namespace dibhr::test::falcon {

/// The eight bytes before every control transfer.
struct ControlSetup {
    std::uint8_t type{0};
    std::uint8_t request{0};
    std::uint16_t value{0};
    std::uint16_t index{0};
    std::uint16_t length{0};
};

/// The rate that a request 3 asks for; 0 when the chip knows none such.
[[nodiscard]] unsigned baud_of(std::uint16_t value, std::uint16_t index) noexcept;

class FtdiChip {
  public:
    /// A vendor request: bytes put into `data`, or nothing when the chip stalls it.
    std::optional<std::size_t> control(const ControlSetup& setup, std::span<std::uint8_t> data);

    /// A byte from the board's serial line, whole at `arrives`.
    void receive(std::uint8_t byte, Moment arrives);
    /// The line status of the next packet carries these bits too.
    void report_line_error(std::uint8_t bits) noexcept { line_errors_ |= bits; }

    /// When the chip has a packet for the host, without another byte from the board. `immediate`:
    /// bytes do not wait for the latency timer.
    [[nodiscard]] Moment next_packet(bool immediate) const;
    /// Fills `packet` (two status bytes first) with at most `most_data` bytes of data; its size.
    std::size_t take_packet(std::span<std::uint8_t> packet, std::size_t most_data, Moment now);

    [[nodiscard]] unsigned baud() const noexcept { return baud_; }
    [[nodiscard]] bool dtr() const noexcept { return dtr_; }
    [[nodiscard]] bool rts() const noexcept { return rts_; }
    [[nodiscard]] unsigned latency_ms() const noexcept { return latency_ms_; }
    [[nodiscard]] bool flushes() const noexcept { return event_character_.has_value(); }

  private:
    struct TimedByte {
        Moment arrives;
        std::uint8_t byte;
    };

    bool set(const ControlSetup& setup);

    std::deque<TimedByte> to_host_{};
    Moment last_packet_{0};
    Moment held_back_until_{0};  // the rest of a reply that was cut
    unsigned baud_{9600};
    unsigned latency_ms_{16};  // after power-up
    std::optional<std::uint8_t> event_character_{};
    bool dtr_{false};
    bool rts_{false};
    std::uint8_t line_errors_{0};
};

}  // namespace dibhr::test::falcon
