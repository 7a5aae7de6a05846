// Checks the samples of an arm over time: whether its poses are valid, and how strong a force may
// be. A pure computation, without clock or library.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

#include "core/haptics/vec.hpp"
#include "device/hand/epoch.hpp"
#include "device/hand/pose_trust.hpp"
#include "device/hand/still_pose.hpp"
#include "device/openhaptics/faults.hpp"
#include "device/openhaptics/hd.hpp"
#include "device/openhaptics/status.hpp"

namespace dibhr::openhaptics {

/// What the library reports in one servo tick.
struct ArmSample {
    Vec3 position_m{0.0};
    Vec3 velocity_m_per_s{0.0};
    std::array<long, 6> encoders{};  ///< the first three: of the arm
    Vec3 gimbal_rad{0.0};
    double warmest{0.0};  ///< temperature of the warmest motor, 0 cold .. 1 hot
    HdEnum calibration{kHdNeedsPerson};
    FaultClass fault{FaultClass::none};  ///< of the frame before
    bool may_output{false};              ///< the force output is switched on
};

/// The arm's encoders stand still while the stylus turns: an arm without calibration.
class StillEncoders {
  public:
    /// Travel of the stylus that no hand manages without moving the arm [rad].
    static constexpr double kTurn_rad = 0.5;

    /// True: since the arm's encoders last changed, the stylus has turned that far.
    [[nodiscard]] bool add(const std::array<long, 6>& encoders, Vec3 gimbal_rad) noexcept;

  private:
    std::array<long, 3> last_{};
    std::optional<Vec3> start_rad_{};  ///< of the gimbal, since the arm moved last
};

class ArmWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr int kSettling = 100;  ///< samples that no force follows: README.md, Numbers
    static constexpr std::chrono::milliseconds kLongestGap{20};
    static constexpr std::chrono::milliseconds kFaultRests{500};  ///< no force after a fault
    static constexpr double kWarm = 0.7;                          ///< warmer motors get less force
    static constexpr double kCool = 0.5;  ///< below it they no longer count as warm

    /// Resets for a new link. The epochs continue.
    void begin() noexcept;
    /// A sample taken at `at`.
    void add(const ArmSample& sample, Time at) noexcept;

    /// Why the arm cannot touch; `ready`: it can.
    [[nodiscard]] Stage stage() const noexcept { return stage_; }
    /// From the second valid sample in a row; a new epoch after each gap and jump.
    [[nodiscard]] Epoch epoch() const noexcept { return trust_.epoch(); }
    /// Share of the continuous force that the motors stand now, 0 .. 1.
    [[nodiscard]] double force_share() const noexcept { return share_; }
    [[nodiscard]] bool warm() const noexcept { return warm_; }

  private:
    [[nodiscard]] Stage stage_of(const ArmSample& sample, Time at) noexcept;
    void follow_motors(double warmest) noexcept;

    Stage stage_{Stage::starting};
    PoseTrust trust_{};
    int samples_{0};  // stops at kSettling
    Time last_at_{};
    std::optional<Time> fault_at_{};
    Stage fault_stage_{Stage::force_cut};
    StillPose still_{};
    StillEncoders encoders_{};
    double share_{1.0};
    bool warm_{false};
};

}  // namespace dibhr::openhaptics
