// Changed parameters go to their new values in a tenth of a second.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"

namespace dibhr {

/// Keeps the force from jumping when a slider is dragged while the hand rests on the surface. Every
/// number that the force depends on goes linearly from its present value to the new one in a tenth
/// of a second; a further change starts from the present value. Applied at once: the algorithm, the
/// sizes of a pixel and of the bump map, the low-pass, a lowered force limit, and all limits that
/// are no force. Deterministic: a replay gives the same values.
class ParameterGlide {
  public:
    static constexpr double kDuration_s = 0.1;

    /// What is tuned in contact: what the force follows from, and what limits it.
    struct Values {
        TouchParameters parameters{};
        SafetyLimits limits{};

        bool operator==(const Values&) const = default;
    };

    /// The values `dt_s` after the last call, on their way to `target`. `at_once`: `target` itself,
    /// where the force begins from zero or nothing was rendered before. No allocation.
    const Values& towards(const Values& target, double dt_s, bool at_once) noexcept;
    /// The values of the last call, and whether they were still on their way.
    [[nodiscard]] const Values& now() const noexcept { return now_; }
    [[nodiscard]] bool under_way() const noexcept { return age_s_ < kDuration_s; }

  private:
    Values from_{};
    Values to_{};
    Values now_{};
    double age_s_{kDuration_s};
    bool started_{false};
};

}  // namespace dibhr
