// The exchange with one Falcon, from the first command to the last: homing, poses, forces.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "device/falcon/homing_watch.hpp"
#include "device/falcon/link.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/thread_buffers.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/delay_watch.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::falcon {

/// State of the driver that is kept from one link to the next.
struct DriverState {
    HomingWatch homing{};
    ButtonDebounce buttons{};
    DelayWatch delay{};
    std::uint64_t replies{0};
    LinkCounts counts{};  ///< sum over the earlier links
};

/// Runs on the USB thread. A force is sent only while all axes are homed and only for a pose of
/// this epoch; after 20 ms zero replaces it. Otherwise zero is sent, at least every 12 ms. Every
/// pass of the loop is a beat for the guardian.
class ExchangeLoop {
  public:
    /// The Falcon at `port` must answer. Throws UsbError.
    ExchangeLoop(const UsbContext& usb, FtdiPort& port, ThreadBuffers& buffers, StatusBoard& board,
                 DriverState& driver_state, Guardian& guardian);
    ~ExchangeLoop();
    ExchangeLoop(const ExchangeLoop&) = delete;
    ExchangeLoop& operator=(const ExchangeLoop&) = delete;

    /// Returns after a stop request, or when the link is lost: then the reason.
    [[nodiscard]] std::optional<UsbError> run(const std::stop_token& stop);

  private:
    using Time = Link::Time;

    [[nodiscard]] Time next_deadline() const noexcept;
    void take(const Reply& reply, Time now);
    /// Raises the chip's latency while no haptic loop runs: fewer empty packets.
    void pace_chip(Time now);
    void send_if_due(Time now);
    [[nodiscard]] Command command(Time now);
    void report(Time now);
    void publish_stage(Time now);
    void count_rate(Time now);

    FtdiPort& port_;
    ThreadBuffers& buffers_;
    StatusBoard& board_;
    DriverState& driver_state_;
    Guardian& guardian_;
    Link link_;

    Time last_sent_{};
    Time force_ends_{Time::max()};  // when the sent force becomes too old; max: no force was sent
    int zeros_pending_{0};
    bool was_ready_{false};
    bool was_idle_{false};
    int axes_{0};
    std::uint64_t rate_from_{0};  // Memory::replies when this measurement of the rate began
    Time rate_since_{};
    Time last_loop_update_{};  // when the haptic loop's last command was taken
    bool loop_paused_{false};
};

}  // namespace dibhr::falcon
