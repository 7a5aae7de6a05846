// A force on the grip of a device that is checked: announced, watched by its person, and let go.
#pragma once

#include <chrono>
#include <functional>

#include "device/hand/check/guide.hpp"

namespace dibhr {

inline constexpr double kStandardGravity = 9.80665;  // m/s2: what a kitchen scale counts on

/// From the announcement of a force to its end, whatever ends it. The person must have agreed.
class CheckPush {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `let_go` leaves the device without force and does not throw; `guide` outlives this.
    CheckPush(CheckGuide& guide, std::function<void()> let_go);
    ~CheckPush() { release(); }
    CheckPush(const CheckPush&) = delete;
    CheckPush& operator=(const CheckPush&) = delete;

    /// Lets go of the device; once.
    void release() noexcept;
    /// Asks the person, about every millisecond of a force; false: it is to end. Throws
    /// PersonQuits, and has let go then.
    [[nodiscard]] bool goes_on();
    /// No packet and no message for so long. `wait` waits until a moment at most 5 ms away; after
    /// each the person is asked: as goes_on().
    [[nodiscard]] bool be_silent(std::chrono::milliseconds span,
                                 const std::function<void(Time)>& wait);

  private:
    CheckGuide& guide_;
    std::function<void()> let_go_;
    bool acts_{true};
};

}  // namespace dibhr
