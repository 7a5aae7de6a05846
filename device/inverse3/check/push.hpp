// A force on an Inverse3's grip: the only part of the check that sends a force other than zero.
#pragma once

#include <optional>
#include <string>

#include "device/hand/check/push.hpp"
#include "device/inverse3/check/context.hpp"

namespace dibhr::inverse3 {

inline constexpr Vec3 kWeak_newton{-0.5, 0.0, 0.0};  // to the left

/// The state reports at least 5 % of the weak force: the service's filters may reduce it so far.
[[nodiscard]] bool reports_weak_force(const Arm& state);

/// A force acts during the lifetime of this object; the destructor ends it.
class Push : public CheckPush {
  public:
    explicit Push(CheckContext& context);

    // These throw ForceReleased, PersonQuits and DeviceError.

    /// Rises to the force and holds it for `hold`.
    void hold(Vec3 force_newton, ForceDialect dialect, CheckTimes::Span hold);
    /// Sends nothing.
    void pause_sending(CheckTimes::Span span);

    /// The state in the answer to the last force; nothing: none was sent.
    [[nodiscard]] const std::optional<Arm>& last() const noexcept { return last_; }
    /// For how long the whole force was held [s].
    [[nodiscard]] double held_s() const noexcept { return held_s_; }
    /// Adds sent and reported force, first and last position, and how long the force was held.
    void add_to(Json& part) const;

  private:
    CheckContext& context_;
    Vec3 sent_newton_{0.0};
    std::optional<Arm> first_{};
    std::optional<Arm> last_{};
    double held_s_{0.0};
};

/// The longest time after which a force was still there, and the shortest after which it was gone.
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
