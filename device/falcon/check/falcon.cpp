// The Falcon under check.
#include "device/falcon/check/falcon.hpp"

#include <algorithm>
#include <stop_token>

#include "device/falcon/bring_up.hpp"

namespace dibhr::falcon {

namespace {

constexpr std::chrono::milliseconds kBeatPeriod{10};  // the guardian's timeout is 50 ms

}  // namespace

CheckedFalcon::CheckedFalcon(const std::string& serial) {
    const std::vector<AttachedFalcon> attached = attached_falcons(usb_);
    const auto found = choose(attached, serial);
    if (!found) throw DeviceError(why_none(attached, serial));
    which_ = *found;
}

CheckedFalcon::~CheckedFalcon() {
    close_link();
}

FtdiPort& CheckedFalcon::port() {
    close_link();
    if (!port_) port_.emplace(usb_, which_);
    return *port_;
}

bool CheckedFalcon::answers() {
    answering_ = falcon::answers(port(), std::stop_token());
    return answering_;
}

Link& CheckedFalcon::open_link() {
    if (!link_) {
        FtdiPort& opened = port();
        guarded_.emplace(guardian_, opened.descriptor(usb_), stop_packet());
        opened.request(event_character_ ? kFlushOnReplyEnd : kNoEventCharacter);
        link_.emplace(usb_, opened, wake_);
    }
    return *link_;
}

void CheckedFalcon::close_link() noexcept {
    if (!link_) return;
    const bool unplugged = link_->loss() && link_->loss()->unplugged();
    link_.reset();
    if (!unplugged) send_stop_packets(*port_);
    guarded_.reset();
}

void CheckedFalcon::wait(Clock::time_point until) {
    open_link().wait(std::min(until, Clock::now() + kBeatPeriod));
    guardian_.beat();
    if (link_->loss()) throw UsbError(*link_->loss());
    if (guardian_.died()) {
        throw DeviceError(
            "the process that takes the force off when dibhr dies was ended: begin "
            "the check again");
    }
}

std::optional<CheckedFalcon::Received> CheckedFalcon::exchange(const Command& command,
                                                               Clock::duration period) {
    constexpr std::chrono::milliseconds kReplyLimit{20};  // ../README.md, Safety numbers
    Link& link = open_link();
    const auto begin = Clock::now();
    std::optional<Clock::time_point> sent;
    std::optional<Received> received;
    for (auto now = begin; !received || now < begin + period; now = Clock::now()) {
        if (!received && now > begin + kReplyLimit) return std::nullopt;
        if (!sent && link.can_send(now)) {
            link.send(encode(command), now);
            sent = now;
        }
        const auto patience = received ? begin + period : begin + kReplyLimit;
        wait(sent ? patience : std::min(patience, link.retry_at()));
        if (sent && !received && !link.replies().empty()) {
            const auto came = Clock::now();
            received = Received{link.replies().back(), came, came - *sent};
        }
    }
    return received;
}

void CheckedFalcon::pause_sending(Clock::time_point until) {
    while (Clock::now() < until) wait(until);
}

LinkCounts CheckedFalcon::counts() {
    return open_link().counts();
}

void CheckedFalcon::release_force() noexcept {
    if (!link_ && port_ && answering_) send_stop_packets(*port_);
    close_link();
    port_.reset();
}

bool CheckedFalcon::find_again() {
    release_force();
    const auto found = choose(attached_falcons(usb_), which_.serial);
    if (found) which_ = *found;
    return found.has_value();
}

}  // namespace dibhr::falcon
