// Checks the states of an arm over time: whether its poses are valid, whether it takes forces, and
// whether another program uses it. A pure computation, without clock or socket.
#pragma once

#include <chrono>
#include <optional>

#include "core/haptics/vec.hpp"
#include "device/hand/pose_trust.hpp"
#include "device/hand/still_pose.hpp"
#include "device/inverse3/message.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr::inverse3 {

/// Whether the arm may be used for touching; updated with every state.
class ArmWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Resets for another arm or a new link. The epochs continue.
    void begin() noexcept;
    /// A state received at `at`.
    void add(const Arm& arm, Time at) noexcept;
    /// A message without this arm, or one that is not valid.
    void add_gap() noexcept;
    /// A force was sent at `at`; `pushes`: it was not zero.
    void force_sent(Time at, bool pushes) noexcept;

    /// Why the arm cannot touch; `ready`: it can.
    [[nodiscard]] Stage stage() const noexcept { return stage_; }
    /// From the second valid state in a row; a new epoch after each gap and jump.
    [[nodiscard]] Epoch epoch() const noexcept { return trust_.epoch(); }
    /// The last position jumped: the configuration has to be read again.
    [[nodiscard]] bool jumped() const noexcept { return trust_.jumped(); }

  private:
    [[nodiscard]] Stage stage_of(const Arm& arm) const noexcept;
    void follow_use(bool in_use, Time at) noexcept;
    [[nodiscard]] bool stands_still(const Arm& arm, Time at) noexcept;

    Stage stage_{Stage::no_device};
    PoseTrust trust_{};
    StillPose still_{};
    std::optional<ArmConfig> config_{};  // the last received one
    std::optional<Time> driven_since_{};
    std::optional<Time> pushed_since_{};  // when the force last rose from zero
    bool pushes_{false};
    bool was_in_use_{false};
    bool used_by_us_{false};
};

/// Whether the service takes our forces: it has to report back the forces that were sent.
class ForceEchoWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;
    enum class Obeys { unknown, yes, no };

    void begin() noexcept;
    /// `reported_newton`: the force in the state that answered a message with `sent_newton`.
    void add(Vec3 sent_newton, const std::optional<Vec3>& reported_newton, Time at) noexcept;
    [[nodiscard]] Obeys obeys() const noexcept { return obeys_; }

  private:
    Obeys obeys_{Obeys::unknown};
    std::optional<Time> no_echo_since_{};
};

}  // namespace dibhr::inverse3
