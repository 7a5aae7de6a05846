// Follows homing over the replies.
#include "device/falcon/homing_watch.hpp"

#include <bit>
#include <cstddef>
#include <cstdlib>

namespace dibhr::falcon {

namespace {

constexpr int kMotion_counts = 25;             // 0.9 degrees of thigh: more than an encoder's noise
constexpr std::chrono::seconds kPatience{20};  // README.md, Homing and lamp

}  // namespace

bool moved_between(const Counts& a, const Counts& b) noexcept {
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (std::abs(a[k] - b[k]) > kMotion_counts) return true;
    }
    return false;
}

int homed_axes(std::uint8_t homed) noexcept {
    return std::popcount(static_cast<unsigned>(homed & kAllAxes));
}

std::string how_to_home(int axes) {
    return (axes == 0 ? "homing" : "homing, " + std::to_string(axes) + " of 3 axes done") +
           ": pull the grip all the way out, then push it straight in";
}

void HomingWatch::begin(Time now) noexcept {
    full_replies_ = 0;
    placed_ = false;
    still_since_ = now;
}

void HomingWatch::add(const Reply& reply, Time at) noexcept {
    if ((reply.homed & kAllAxes) != kAllAxes) {
        if (ready()) begin(at);
        full_replies_ = 0;
    } else if (full_replies_ < 2 && ++full_replies_ == 2) {
        ++epoch_;
        if (epoch_ == kNoEpoch) ++epoch_;
    }
    look_for_motion(reply, at);
}

bool HomingWatch::idle(Time now) const noexcept {
    return !ready() && now - still_since_ >= kPatience;
}

void HomingWatch::look_for_motion(const Reply& reply, Time at) noexcept {
    const bool moved = placed_ && moved_between(reply.encoder, last_place_.encoder);
    if (placed_ && !moved && reply.homed == last_place_.homed) return;
    if (placed_) still_since_ = at;
    last_place_ = reply;
    placed_ = true;
}

}  // namespace dibhr::falcon
