// A force on the grip during a device check: announced, ended at once on the user's request.
#pragma once

#include <chrono>
#include <functional>

#include "device/hand/check/console.hpp"

namespace dibhr {

inline constexpr double kStandardGravity = 9.80665;  // m/s2, which a kitchen scale assumes

/// Lasts from the announcement of a force to its end, whatever ends it. The user must have agreed.
class CheckPush {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `release_force` leaves the device without force and does not throw; `console` outlives this.
    CheckPush(CheckConsole& console, std::function<void()> release_force);
    ~CheckPush() { release(); }
    CheckPush(const CheckPush&) = delete;
    CheckPush& operator=(const CheckPush&) = delete;

    /// Ends the force; later calls do nothing.
    void release() noexcept;
    /// Polls the user's request, about every millisecond of a force; false: end the force. Throws
    /// PersonQuits after it has ended the force.
    [[nodiscard]] bool may_continue();
    /// Sends nothing for `span`. `wait` sleeps until a time at most 5 ms away; after each sleep the
    /// user's request is polled. Result as of may_continue().
    [[nodiscard]] bool pause_sending(std::chrono::milliseconds span,
                                     const std::function<void(Time)>& wait);

  private:
    CheckConsole& console_;
    std::function<void()> release_force_;
    bool acts_{true};
};

}  // namespace dibhr
