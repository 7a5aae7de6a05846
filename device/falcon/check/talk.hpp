// One command, one reply, for as long as a Falcon is checked.
#pragma once

#include <chrono>
#include <optional>

#include "device/falcon/exchange.hpp"
#include "device/falcon/link.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

class CheckTalk {
  public:
    using Clock = Link::Clock;

    struct Heard {
        Reply reply{};
        Clock::time_point at{};
        Clock::duration round_trip{};  ///< from the command to its reply
    };

    /// The port's Falcon must answer, and is used otherwise only after the talk. Throws UsbError.
    CheckTalk(const UsbContext& usb, FtdiPort& port);
    ~CheckTalk();  ///< five packets without force
    CheckTalk(const CheckTalk&) = delete;
    CheckTalk& operator=(const CheckTalk&) = delete;

    /// Sends `command` and gives its reply, not before `period` has passed. Nothing when none came
    /// within 20 ms. Throws UsbError when the link is lost.
    std::optional<Heard> exchange(const Command& command, Clock::duration period = {});
    /// Sends nothing until `until`. Throws UsbError when the link is lost.
    void be_silent(Clock::time_point until);

    [[nodiscard]] LinkCounts counts() const noexcept { return link_->counts(); }

  private:
    void wait(Clock::time_point until);

    FtdiPort& port_;
    Wake wake_{};
    std::optional<Link> link_{};
};

}  // namespace dibhr::falcon
