// Which positions of an arm belong together: a gap or a jump ends an epoch.
#pragma once

#include <chrono>
#include <glm/geometric.hpp>
#include <optional>

#include "core/haptics/vec.hpp"
#include "device/hand/epoch.hpp"

namespace dibhr {

/// Updated with every reading of an arm.
class PoseTrust {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr double kFastest_m_per_s = 10.0;  ///< no hand is faster
    static constexpr double kAllowance_m = 0.02;      ///< added to the greatest step of that speed

    /// Resets for another arm or a new link. The epochs continue.
    void begin() noexcept {
        const Epoch epoch = epoch_;
        *this = PoseTrust{};
        epoch_ = epoch;
    }
    /// A position received at `at`; nothing: the reading has none. `usable`: it may move the goal.
    void add(const std::optional<Vec3>& position_m, Time at, bool usable) noexcept {
        jumped_ = position_m && jumps_to(*position_m, at);
        if (!usable || !position_m || jumped_) {
            trusted_ = 0;
        } else if (trusted_ < 2 && ++trusted_ == 2) {
            ++epoch_;
            if (epoch_ == kNoEpoch) ++epoch_;
        }
        last_m_ = position_m;
        last_at_ = at;
    }
    /// No reading came, or one that is not valid.
    void add_gap() noexcept {
        trusted_ = 0;
        last_m_.reset();
    }

    /// From the second usable reading in a row; a new epoch after each gap and jump.
    [[nodiscard]] Epoch epoch() const noexcept { return trusted_ >= 2 ? epoch_ : kNoEpoch; }
    /// The last position jumped.
    [[nodiscard]] bool jumped() const noexcept { return jumped_; }

  private:
    [[nodiscard]] bool jumps_to(Vec3 position_m, Time at) const noexcept {
        if (!last_m_) return false;
        const std::chrono::duration<double> passed = at - last_at_;
        return glm::distance(position_m, *last_m_) >
               kAllowance_m + kFastest_m_per_s * passed.count();
    }

    Epoch epoch_{kNoEpoch};
    int trusted_{0};  // usable readings in a row; stops at 2
    bool jumped_{false};
    std::optional<Vec3> last_m_{};
    Time last_at_{};
};

}  // namespace dibhr
