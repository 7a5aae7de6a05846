// One command, one reply.
#include "device/falcon/check/talk.hpp"

#include <algorithm>

#include "device/falcon/probe.hpp"

namespace dibhr::falcon {

namespace {

// ../README.md, Safety numbers: the caller must hear of it.
constexpr std::chrono::milliseconds kReplyLimit{20};

}  // namespace

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

}  // namespace dibhr::falcon
