// The one Falcon that is checked.
#include "device/falcon/check/falcon.hpp"

#include <algorithm>
#include <stop_token>

#include "device/falcon/probe.hpp"
#include "device/falcon/upload.hpp"

namespace dibhr::falcon {

CheckTalk::CheckTalk(const UsbContext& usb, FtdiPort& port) : port_(port) {
    link_.emplace(usb, port, wake_);
}

CheckTalk::~CheckTalk() {
    const bool gone = link_->loss() && link_->loss()->gone();
    link_.reset();
    if (!gone) leave_without_force(port_);
}

void CheckTalk::wait(Clock::time_point until) {
    link_->wait(until);
    if (link_->loss()) throw UsbError(*link_->loss());
}

std::optional<CheckTalk::Heard> CheckTalk::exchange(const Command& command,
                                                    Clock::duration period) {
    constexpr std::chrono::milliseconds kReplyLimit{20};  // ../README.md, Safety numbers
    const auto begin = Clock::now();
    std::optional<Clock::time_point> sent;
    std::optional<Heard> heard;
    for (auto now = begin; !heard || now < begin + period; now = Clock::now()) {
        if (!heard && now > begin + kReplyLimit) return std::nullopt;
        if (!sent && link_->takes_command(now)) {
            link_->send(encode(command), now);
            sent = now;
        }
        const auto patience = heard ? begin + period : begin + kReplyLimit;
        wait(sent ? patience : std::min(patience, link_->patience_ends()));
        if (sent && !heard && !link_->replies().empty()) {
            const auto came = Clock::now();
            heard = Heard{link_->replies().back(), came, came - *sent};
        }
    }
    return heard;
}

void CheckTalk::be_silent(Clock::time_point until) {
    while (Clock::now() < until) wait(until);
}

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
