// A force on the grip during a device check: announced, ended at once on the user's request.
#pragma once

#include <chrono>
#include <functional>

#include "device/hand/check/guide.hpp"

namespace dibhr {

inline constexpr double kStandardGravity = 9.80665;  // m/s2, which a kitchen scale assumes

/// Lasts from the announcement of a force to its end, whatever ends it. The user must have agreed.
class CheckPush {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `let_go` leaves the device without force and does not throw; `guide` outlives this.
    CheckPush(CheckGuide& guide, std::function<void()> let_go);
    ~CheckPush() { release(); }
    CheckPush(const CheckPush&) = delete;
    CheckPush& operator=(const CheckPush&) = delete;

    /// Ends the force; later calls do nothing.
    void release() noexcept;
    /// Polls the user's request, about every millisecond of a force; false: end the force. Throws
    /// PersonQuits after it has ended the force.
    [[nodiscard]] bool goes_on();
    /// Sends nothing for `span`. `wait` sleeps until a time at most 5 ms away; after each sleep the
    /// user's request is polled. Result as of goes_on().
    [[nodiscard]] bool be_silent(std::chrono::milliseconds span,
                                 const std::function<void(Time)>& wait);

  private:
    CheckGuide& guide_;
    std::function<void()> let_go_;
    bool acts_{true};
};

}  // namespace dibhr
