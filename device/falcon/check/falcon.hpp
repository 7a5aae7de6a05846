// The Falcon under check: found by its serial, opened and closed as the steps need it. While the
// link is open, it exchanges one command and one reply at a time.
#pragma once

#include <optional>
#include <string>

#include "device/falcon/link.hpp"
#include "device/falcon/packet.hpp"
#include "device/falcon/thread_buffers.hpp"
#include "device/falcon/usb.hpp"
#include "device/hand/guardian.hpp"

namespace dibhr::falcon {

class CheckedFalcon {
  public:
    using Clock = Link::Clock;

    struct Received {
        Reply reply{};
        Clock::time_point at{};
        Clock::duration round_trip{};  ///< from the command to its reply
    };

    /// The Falcon with this serial; when it is empty, the first. Throws DeviceError when there is
    /// none.
    explicit CheckedFalcon(const std::string& serial);
    ~CheckedFalcon();  ///< sends five packets without force, if the link is open
    CheckedFalcon(const CheckedFalcon&) = delete;
    CheckedFalcon& operator=(const CheckedFalcon&) = delete;

    [[nodiscard]] const AttachedFalcon& attached() const noexcept { return which_; }
    /// Why no guardian watches, in a line; empty when one does.
    [[nodiscard]] std::string unguarded() const { return guardian_.fault(); }

    /// The port, opened if needed. Closes the link, which must not use the port at the same time.
    /// Throws UsbError.
    FtdiPort& port();
    /// Sets run-time speed and probes for a reply; closes the link. Throws UsbError.
    bool answers();
    /// Sets the result of answers() where an upload has shown it.
    void set_answering(bool answering) noexcept { answering_ = answering; }
    [[nodiscard]] bool answering() const noexcept { return answering_; }
    /// Whether the chip flushes on '>', for the next link.
    void use_event_character(bool use) noexcept { event_character_ = use; }

    // These open the link where needed. Only when answering(); throw UsbError when it is lost.

    /// Sends `command` and returns its reply, not before `period` has passed. Nothing when no reply
    /// came within 20 ms.
    std::optional<Received> exchange(const Command& command, Clock::duration period = {});
    /// Sends nothing until `until`.
    void pause_sending(Clock::time_point until);
    /// Counts of this link.
    [[nodiscard]] LinkCounts counts();

    /// Sends five packets without force to a Falcon that answers; then closes the port.
    void release_force() noexcept;
    /// Closes the port and finds the Falcon on the USB again, by its serial. Throws UsbError.
    [[nodiscard]] bool find_again();

  private:
    Link& open_link();
    void close_link() noexcept;
    void wait(Clock::time_point until);

    Guardian guardian_{"Falcon"};
    UsbContext usb_{};
    Wake wake_{};
    AttachedFalcon which_{};
    bool answering_{false};
    bool event_character_{false};
    std::optional<FtdiPort> port_{};
    std::optional<Guarded> guarded_{};  // from opening the link until after the last packet
    std::optional<Link> link_{};
};

}  // namespace dibhr::falcon
