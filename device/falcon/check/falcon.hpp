// The one Falcon that is checked: found by its serial, opened and closed as the steps need it, and
// one command, one reply, for as long as they talk to it.
#pragma once

#include <optional>
#include <string>

#include "device/falcon/exchange.hpp"
#include "device/falcon/link.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::falcon {

class CheckedFalcon {
  public:
    using Clock = Link::Clock;

    struct Heard {
        Reply reply{};
        Clock::time_point at{};
        Clock::duration round_trip{};  ///< from the command to its reply
    };

    /// The one with this serial; when it is empty, the first. Throws DeviceError when there is
    /// none.
    explicit CheckedFalcon(const std::string& serial);
    ~CheckedFalcon();  ///< five packets without force, when it was talked to
    CheckedFalcon(const CheckedFalcon&) = delete;
    CheckedFalcon& operator=(const CheckedFalcon&) = delete;

    [[nodiscard]] const AttachedFalcon& attached() const noexcept { return which_; }
    /// Why no guardian watches, in a line; empty when one does.
    [[nodiscard]] std::string unguarded() const { return guardian_.fault(); }

    /// Opened if it is not; no talk, as the port is used otherwise. Throws UsbError.
    FtdiPort& port();
    /// Sets run-time speed and asks for a reply; ends the talk. Throws UsbError.
    bool answers();
    /// What answers() would say: an upload has found out.
    void set_answering(bool answering) noexcept { answering_ = answering; }
    [[nodiscard]] bool answering() const noexcept { return answering_; }
    /// Whether the chip flushes on '>' from the next talk on.
    void use_event_character(bool use) noexcept { event_character_ = use; }

    // The talk begins by itself. Only when answering(); these throw UsbError when the link is lost.

    /// Sends `command` and gives its reply, not before `period` has passed. Nothing when none came
    /// within 20 ms.
    std::optional<Heard> exchange(const Command& command, Clock::duration period = {});
    /// Sends nothing until `until`.
    void be_silent(Clock::time_point until);
    /// Of this talk.
    [[nodiscard]] LinkCounts counts();

    /// Five packets without force to a Falcon that answers; then closes the port.
    void let_go() noexcept;
    /// Lets go and looks for it on the USB again, by its serial. Throws UsbError.
    [[nodiscard]] bool look_again();

  private:
    Link& talk();
    void end_talk() noexcept;
    void wait(Clock::time_point until);

    Guardian guardian_{"Falcon"};
    UsbContext usb_{};
    Wake wake_{};
    AttachedFalcon which_{};
    bool answering_{false};
    bool event_character_{false};
    std::optional<FtdiPort> port_{};
    std::optional<Guarded> guarded_{};  // while it is talked to, and until after the last packet
    std::optional<Link> talk_{};
};

}  // namespace dibhr::falcon
