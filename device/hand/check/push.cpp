// A force on the grip during a device check.
#include "device/hand/check/push.hpp"

#include <algorithm>
#include <utility>

#include "device/hand/check/questions.hpp"

namespace dibhr {

CheckPush::CheckPush(CheckConsole& console, std::function<void()> release_force)
    : console_(console), release_force_(std::move(release_force)) {
    console_.force_begins();
}

void CheckPush::release() noexcept {
    if (!std::exchange(acts_, false)) return;
    release_force_();
    console_.force_ended();
}

bool CheckPush::may_continue() {
    const CheckConsole::Request request = console_.request();
    if (request == CheckConsole::Request::quit) {
        release();
        throw PersonQuits{};
    }
    return request == CheckConsole::Request::none;
}

bool CheckPush::pause_sending(std::chrono::milliseconds span,
                              const std::function<void(Time)>& wait) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kLook{5};
    const auto end = Clock::now() + span;
    for (auto now = Clock::now(); now < end; now = Clock::now()) {
        if (!may_continue()) return false;
        wait(std::min(end, now + kLook));
    }
    return may_continue();
}

}  // namespace dibhr
