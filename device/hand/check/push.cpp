// A force on the grip during a device check.
#include "device/hand/check/push.hpp"

#include <algorithm>
#include <utility>

#include "device/hand/check/questions.hpp"

namespace dibhr {

CheckPush::CheckPush(CheckGuide& guide, std::function<void()> let_go)
    : guide_(guide), let_go_(std::move(let_go)) {
    guide_.force_begins();
}

void CheckPush::release() noexcept {
    if (!std::exchange(acts_, false)) return;
    let_go_();
    guide_.force_ended();
}

bool CheckPush::goes_on() {
    const CheckGuide::Wish wish = guide_.wish();
    if (wish == CheckGuide::Wish::quit) {
        release();
        throw PersonQuits{};
    }
    return wish == CheckGuide::Wish::none;
}

bool CheckPush::be_silent(std::chrono::milliseconds span, const std::function<void(Time)>& wait) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kLook{5};
    const auto end = Clock::now() + span;
    for (auto now = Clock::now(); now < end; now = Clock::now()) {
        if (!goes_on()) return false;
        wait(std::min(end, now + kLook));
    }
    return goes_on();
}

}  // namespace dibhr
