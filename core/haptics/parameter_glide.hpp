// Parameters on their way from what they were to what a person has set.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"

namespace dibhr {

/// A hand rests on the surface while somebody drags a slider: every number that the force follows
/// from goes straight from what it is to what it is to be, in a tenth of a second, and starts anew
/// from where it is when it is changed again. The algorithm, the sizes of a pixel and of the bump
/// map, the low-pass, a lowered limit of the force and the limits that are no force are what they
/// are at once. Deterministic: a recorded session takes the same way.
class ParameterGlide {
  public:
    static constexpr double kDuration_s = 0.1;

    /// What is tuned in contact: what the force follows from, and what limits it.
    struct Values {
        TouchParameters parameters{};
        SafetyLimits limits{};

        bool operator==(const Values&) const = default;
    };

    /// Where the numbers are `dt_s` after the last call, on their way to `target`. `at_once`: they
    /// are there, because the force begins from zero, or nothing was felt before. No allocation.
    const Values& towards(const Values& target, double dt_s, bool at_once) noexcept;
    /// Where they were then, and whether that was still on the way.
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
