// One simulated Falcon as its USB endpoints show it: FTDI chip, board and faults. Pure logic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/device/falcon/falcon_board.hpp"
#include "tests/device/falcon/faults.hpp"
#include "tests/device/falcon/ftdi_chip.hpp"
#include "tests/device/falcon/moment.hpp"

namespace dibhr::test::falcon {

/// Device descriptor (18 bytes) and the configuration's (32 bytes), as the kernel keeps them.
[[nodiscard]] std::vector<std::uint8_t> falcon_descriptors();

struct Traffic {
    std::uint64_t bytes_out{0};   ///< bulk, from the host
    std::uint64_t slow_bytes{0};  ///< of those, at another rate than the run-time's: an upload's
    std::uint64_t bytes_in{0};    ///< bulk data to the host, without status bytes
    std::uint64_t packets_in{0};
    std::uint64_t empty_packets_in{0};  ///< status bytes only
};

class FalconModel {
  public:
    explicit FalconModel(std::string serial) : serial_(std::move(serial)) {}

    /// A control transfer: bytes put into `data`, or nothing when it is stalled.
    std::optional<std::size_t> control(const ControlSetup& setup, std::span<std::uint8_t> data,
                                       Moment now);
    /// A bulk packet from the host.
    void out(std::span<const std::uint8_t> bytes, Moment now);
    /// When in() will have something, if the host stays silent.
    [[nodiscard]] Moment next_in() const;
    /// The next bulk packet to the host, at most 64 bytes; 0 when there is none yet.
    std::size_t in(std::span<std::uint8_t> packet, Moment now);
    /// Advances the hand and the motors.
    void advance(Moment now) { board_.advance(now); }
    /// The cable is in again: the chip is as new. The motor controller has its own power supply and
    /// keeps its program, unless it is taken too.
    void reconnect() { chip_ = FtdiChip(); }
    void power_cycle();

    Faults faults{};
    /// Bytes take their time on the serial line, and wait for the latency timer; else none.
    bool realtime{false};

    [[nodiscard]] FalconBoard& board() noexcept { return board_; }
    [[nodiscard]] const FtdiChip& chip() const noexcept { return chip_; }
    [[nodiscard]] const Traffic& traffic() const noexcept { return traffic_; }
    [[nodiscard]] const std::string& serial() const noexcept { return serial_; }

  private:
    std::optional<std::size_t> standard_request(const ControlSetup& setup,
                                                std::span<std::uint8_t> data) const;
    void send(const FalconBoard::Bytes& bytes, Moment now);
    void spoil(FalconBoard::Bytes& reply);
    [[nodiscard]] Moment byte_time() const;

    std::string serial_;
    FtdiChip chip_{};
    FalconBoard board_{};
    bool half_out_{false};                // of the reply before
    FalconBoard::Bytes waiting_reply_{};  // for the one it will be merged with
    Moment line_free_{0};                 // the board's sending line
    Traffic traffic_{};
};

}  // namespace dibhr::test::falcon
