// The Falcon under check.
#include "device/falcon/check/falcon.hpp"

#include <algorithm>
#include <stop_token>

#include "device/falcon/bring_up.hpp"

namespace dibhr::falcon {

namespace {

constexpr std::chrono::milliseconds kBeatsEvery{10};  // the guardian's timeout is 50 ms

}  // namespace

CheckedFalcon::CheckedFalcon(const std::string& serial) {
    const std::vector<AttachedFalcon> attached = attached_falcons(usb_);
    const auto found = choose(attached, serial);
    if (!found) throw DeviceError(why_none(attached, serial));
    which_ = *found;
}

CheckedFalcon::~CheckedFalcon() {
    end_talk();
}

FtdiPort& CheckedFalcon::port() {
    end_talk();
    if (!port_) port_.emplace(usb_, which_);
    return *port_;
}

bool CheckedFalcon::answers() {
    answering_ = falcon::answers(port(), std::stop_token());
    return answering_;
}

Link& CheckedFalcon::talk() {
    if (!talk_) {
        FtdiPort& opened = port();
        guarded_.emplace(guardian_, opened.descriptor(usb_), farewell());
        opened.request(event_character_ ? kFlushOnReplyEnd : kNoEventCharacter);
        talk_.emplace(usb_, opened, wake_);
    }
    return *talk_;
}

void CheckedFalcon::end_talk() noexcept {
    if (!talk_) return;
    const bool gone = talk_->loss() && talk_->loss()->gone();
    talk_.reset();
    if (!gone) leave_without_force(*port_);
    guarded_.reset();
}

void CheckedFalcon::wait(Clock::time_point until) {
    talk().wait(std::min(until, Clock::now() + kBeatsEvery));
    guardian_.beat();
    if (talk_->loss()) throw UsbError(*talk_->loss());
    if (guardian_.died()) {
        throw DeviceError(
            "the process that takes the force off when dibhr dies was ended: begin "
            "the check again");
    }
}

std::optional<CheckedFalcon::Heard> CheckedFalcon::exchange(const Command& command,
                                                            Clock::duration period) {
    constexpr std::chrono::milliseconds kReplyLimit{20};  // ../README.md, Safety numbers
    Link& link = talk();
    const auto begin = Clock::now();
    std::optional<Clock::time_point> sent;
    std::optional<Heard> heard;
    for (auto now = begin; !heard || now < begin + period; now = Clock::now()) {
        if (!heard && now > begin + kReplyLimit) return std::nullopt;
        if (!sent && link.takes_command(now)) {
            link.send(encode(command), now);
            sent = now;
        }
        const auto patience = heard ? begin + period : begin + kReplyLimit;
        wait(sent ? patience : std::min(patience, link.patience_ends()));
        if (sent && !heard && !link.replies().empty()) {
            const auto came = Clock::now();
            heard = Heard{link.replies().back(), came, came - *sent};
        }
    }
    return heard;
}

void CheckedFalcon::be_silent(Clock::time_point until) {
    while (Clock::now() < until) wait(until);
}

LinkCounts CheckedFalcon::counts() {
    return talk().counts();
}

void CheckedFalcon::let_go() noexcept {
    if (!talk_ && port_ && answering_) leave_without_force(*port_);
    end_talk();
    port_.reset();
}

bool CheckedFalcon::look_again() {
    let_go();
    const auto found = choose(attached_falcons(usb_), which_.serial);
    if (found) which_ = *found;
    return found.has_value();
}

}  // namespace dibhr::falcon
