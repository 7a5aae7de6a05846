// The only place of the check where a device gets any force but zero.
#pragma once

#include <optional>
#include <string>

#include "device/hand/check/push.hpp"
#include "device/inverse3/check/desk.hpp"

namespace dibhr::inverse3 {

inline constexpr Vec3 kWeak_newton{-0.5, 0.0, 0.0};  // to the left

/// The state tells a force of at least 5 % of the weak one: filters may take most of it away.
[[nodiscard]] bool tells_weak_force(const Arm& state);

/// While it lives a force acts; at its end it does not, whatever happened.
class Push : public CheckPush {
  public:
    explicit Push(CheckDesk& desk);

    // These throw ForceLetGo, PersonQuits and DeviceError.

    /// Rises to the force and holds it for `hold`.
    void hold(Vec3 force_newton, ForceDialect dialect, CheckTimes::Span hold);
    /// Sends nothing.
    void be_silent(CheckTimes::Span span);

    /// The answer to the last force, however it ended; nothing: none was sent.
    [[nodiscard]] const std::optional<Arm>& last() const noexcept { return last_; }
    /// For how long the whole force was held [s].
    [[nodiscard]] double held_s() const noexcept { return held_s_; }
    /// Sent and told force, position at both ends, and for how long the whole force was held.
    void add_to(Json& part) const;

  private:
    CheckDesk& desk_;
    Vec3 sent_newton_{0.0};
    std::optional<Arm> first_{};
    std::optional<Arm> last_{};
    double held_s_{0.0};
};

/// Up to when a force was there, and from when it was gone.
class ForceEnd {
  public:
    void add(double after_ms, bool acts);
    /// "still there after 20.1 ms, gone after 50.2 ms".
    [[nodiscard]] std::string in_words() const;
    void add_to(Json& measured) const;

  private:
    std::optional<double> there_ms_{};  // the longest
    std::optional<double> gone_ms_{};   // the shortest
};

}  // namespace dibhr::inverse3
