// One Falcon that answers, from the first command to the last: homing, poses out, forces in.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "device/falcon/exchange.hpp"
#include "device/falcon/link.hpp"
#include "device/falcon/reply_watch.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/delay_watch.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::falcon {

/// What outlives a link.
struct Memory {
    HomingWatch homing{};
    ButtonDebounce buttons{};
    DelayWatch delay{};
    std::uint64_t replies{0};
    LinkCounts counts{};  ///< of the links that are gone
};

/// On the USB thread. A force reaches the motors only while all axes are homed, for a pose of this
/// epoch, and for 20 ms, when zero follows; everything else is sent as zero, at least every 12 ms.
/// The guardian hears of every pass, which is as often.
class Conversation {
  public:
    /// The port's Falcon must answer. Throws UsbError.
    Conversation(const UsbContext& usb, FtdiPort& port, Exchange& exchange, StatusBoard& board,
                 Memory& memory, Guardian& guardian);
    ~Conversation();
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;

    /// Until asked to stop, or until the link is lost: then why.
    [[nodiscard]] std::optional<UsbError> run(const std::stop_token& stop);

  private:
    using Time = Link::Time;

    [[nodiscard]] Time next_look() const noexcept;
    void take(const Reply& reply, Time now);
    /// While no haptic loop ticks, the chip need not send an empty packet every millisecond.
    void pace_chip(Time now);
    void speak(Time now);
    [[nodiscard]] Command command(Time now);
    void report(Time now);
    void tell_stage(Time now);
    void count_rate(Time now);

    FtdiPort& port_;
    Exchange& exchange_;
    StatusBoard& board_;
    Memory& memory_;
    Guardian& guardian_;
    Link link_;

    Time spoke_{};
    Time force_ends_{Time::max()};  // when the force on the wire is too old; never: there is none
    int zeros_owed_{0};
    bool was_ready_{false};
    bool was_idle_{false};
    int axes_{0};
    std::uint64_t rate_from_{0};  // Memory::replies at the beginning of this second
    Time rate_since_{};
    Time loop_heard_{};  // its last command
    bool loop_paused_{false};
};

}  // namespace dibhr::falcon
