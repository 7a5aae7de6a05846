// The one Falcon that is checked.
#include "device/falcon/check/falcon.hpp"

#include <stop_token>

#include "device/falcon/bring_up.hpp"
#include "device/falcon/probe.hpp"

namespace dibhr::falcon {

CheckedFalcon::CheckedFalcon(const std::string& serial) {
    const std::vector<AttachedFalcon> attached = attached_falcons(usb_);
    const auto found = choose(attached, serial);
    if (!found) throw DeviceError(why_none(attached, serial));
    which_ = *found;
}

FtdiPort& CheckedFalcon::port() {
    talk_.reset();
    if (!port_) port_.emplace(usb_, which_);
    return *port_;
}

bool CheckedFalcon::answers() {
    answering_ = falcon::answers(port(), std::stop_token());
    return answering_;
}

CheckTalk& CheckedFalcon::talk() {
    if (!talk_) {
        FtdiPort& opened = port();
        opened.request(event_character_ ? kFlushOnReplyEnd : kNoEventCharacter);
        talk_.emplace(usb_, opened);
    }
    return *talk_;
}

void CheckedFalcon::let_go() noexcept {
    if (!talk_ && port_ && answering_) leave_without_force(*port_);
    talk_.reset();
    port_.reset();
}

bool CheckedFalcon::look_again() {
    let_go();
    const auto found = choose(attached_falcons(usb_), which_.serial);
    if (found) which_ = *found;
    return found.has_value();
}

}  // namespace dibhr::falcon
