// The one Falcon that is checked: found by its serial, opened and closed as the steps need it.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "device/falcon/exchange.hpp"
#include "device/falcon/link.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

/// One command, one reply, for as long as a Falcon is checked.
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

class CheckedFalcon {
  public:
    /// The one with this serial; when it is empty, the first. Throws DeviceError when there is
    /// none.
    explicit CheckedFalcon(const std::string& serial);

    [[nodiscard]] const AttachedFalcon& attached() const noexcept { return which_; }

    /// Opened if it is not; ends the talk. Throws UsbError.
    FtdiPort& port();
    /// Sets run-time speed and asks for a reply; ends the talk. Throws UsbError.
    bool answers();
    /// What answers() would say: an upload has found out.
    void set_answering(bool answering) noexcept { answering_ = answering; }
    [[nodiscard]] bool answering() const noexcept { return answering_; }
    /// Begun if it is not. Only when answering(). Throws UsbError.
    CheckTalk& talk();
    /// Whether the chip flushes on '>' from the next talk on.
    void use_event_character(bool use) noexcept { event_character_ = use; }

    /// Five packets without force to a Falcon that answers; then closes the port.
    void let_go() noexcept;
    /// Lets go and looks for it on the USB again, by its serial. Throws UsbError.
    [[nodiscard]] bool look_again();

  private:
    UsbContext usb_{};
    AttachedFalcon which_{};
    bool answering_{false};
    bool event_character_{false};
    std::optional<FtdiPort> port_{};
    std::optional<CheckTalk> talk_{};
};

}  // namespace dibhr::falcon
