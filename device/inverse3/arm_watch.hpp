// What an arm's states tell over time: whether its poses may be trusted, whether it obeys, and
// whether somebody else drives it. States in, verdicts out: no clock, no socket.
#pragma once

#include <chrono>
#include <optional>

#include "core/haptics/vec.hpp"
#include "device/hand/epoch.hpp"
#include "device/hand/still_pose.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// Whether the arm may be touched with, from one state to the next.
class ArmWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Another arm, or a new link: nothing is known. Epochs go on counting.
    void begin() noexcept;
    /// A state that came at `at`.
    void add(const Arm& arm, Time at) noexcept;
    /// A message without it, or one that made no sense.
    void miss() noexcept;
    /// A force was sent to it at `at`; `pushes`: it was not zero.
    void drove(Time at, bool pushes) noexcept;

    /// What keeps it from touching; `ready`: nothing.
    [[nodiscard]] Stage stage() const noexcept { return stage_; }
    /// From the second state in a row that can be trusted; another one after each gap and jump.
    [[nodiscard]] Epoch epoch() const noexcept { return trusted_ >= 2 ? epoch_ : kNoEpoch; }
    /// Its configuration is to be read again: it jumped.
    [[nodiscard]] bool jumped() const noexcept { return jumped_; }

  private:
    [[nodiscard]] Stage stage_of(const Arm& arm) const noexcept;
    void follow_use(bool in_use, Time at) noexcept;
    [[nodiscard]] bool stands_still(const Arm& arm, Time at) noexcept;
    [[nodiscard]] bool jumps_to(Vec3 position_m, Time at) const noexcept;

    Stage stage_{Stage::no_device};
    Epoch epoch_{kNoEpoch};
    int trusted_{0};  // states in a row; stops at 2
    bool jumped_{false};
    std::optional<Vec3> last_m_{};
    Time last_at_{};
    StillPose still_{};
    std::optional<ArmConfig> config_{};  // the last one that was told
    std::optional<Time> driven_since_{};
    std::optional<Time> pushed_since_{};  // the last force that was not zero, after one that was
    bool pushes_{false};
    bool was_in_use_{false};
    bool used_by_us_{false};
};

/// Whether the service obeys: forces that are sent have to be told back.
class HearingWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;
    enum class Hears { unknown, yes, no };

    void begin() noexcept;
    /// The state after a force of `sent_newton` was sent.
    void add(Vec3 sent_newton, const std::optional<Vec3>& told_newton, Time at) noexcept;
    [[nodiscard]] Hears hears() const noexcept { return hears_; }

  private:
    Hears hears_{Hears::unknown};
    std::optional<Time> unheard_since_{};
};

}  // namespace dibhr::inverse3
