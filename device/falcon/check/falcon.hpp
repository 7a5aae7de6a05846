// The one Falcon that is checked: found by its serial, opened and closed as the steps need it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "device/falcon/attached.hpp"
#include "device/falcon/check/talk.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

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
