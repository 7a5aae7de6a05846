// A force on a Falcon's grip: the only part of the check that commands a motor.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "core/haptics/vec.hpp"
#include "device/falcon/check/context.hpp"
#include "device/falcon/kinematics.hpp"
#include "device/falcon/packet.hpp"
#include "device/hand/check/push.hpp"

namespace dibhr::falcon {

/// The grip's position for these counts [m]; nothing when the mechanism has none.
[[nodiscard]] std::optional<Vec3> place_of(Vec3 encoder_counts, const Geometry& geometry);

[[nodiscard]] inline Vec3 as_vec(const Counts& counts) noexcept {
    return {counts[0], counts[1], counts[2]};
}

/// Average of the counts.
struct CountsSample {
    Vec3 mean{0.0};
    int replies{0};
};

/// Averages the counts while the motors get zero, over the second half of CheckTimes::sample: in
/// the first half the grip may still swing back after a force. Throws UsbError without replies.
[[nodiscard]] CountsSample sample_counts(CheckContext& context);

/// Motor counts that push the grip straight down from where it is, with `most_counts` on the motor
/// with the largest torque. Prints a note and throws StepSkipped when these counts have no pose.
[[nodiscard]] Counts downward(CheckContext& context, Vec3 encoder_counts, int most_counts);

/// The force downwards [N] of these motor counts at this place for a torque scale of 1 count per
/// newton metre: divide it by the real torque scale.
[[nodiscard]] std::optional<double> downward_force(const Counts& motor, Vec3 encoder_counts,
                                                   const Geometry& geometry);

/// "1.2 to 3.4 N (120 to 350 g)": the expected force for the torque scales of the sources, and for
/// the measured one, once there is one.
[[nodiscard]] std::string strength_of(const CheckContext& context, const Counts& motor,
                                      Vec3 encoder_counts);

/// How a push went.
enum class PushEnd : std::size_t {
    held,        ///< for the whole time
    released,    ///< the user pressed a key
    moved_away,  ///< the grip left its place by more than 30 mm
    not_homed,   ///< an axis was not homed any more
    no_reply     ///< the newest reply was older than 20 ms
};

[[nodiscard]] const char* sentence_of(PushEnd end) noexcept;

/// A force on the grip of a homed Falcon, from its rise to its release. Ended at once with five
/// packets without force when a part of it does not end as `held`, and by the destructor.
class Push : public CheckPush {
  public:
    Push(CheckContext& context, const Counts& motor);

    // These throw PersonQuits and UsbError.

    /// From zero to the whole force, in CheckTimes::ramp.
    [[nodiscard]] PushEnd rise();
    /// At most 3 s.
    [[nodiscard]] PushEnd hold(std::chrono::milliseconds time);
    [[nodiscard]] PushEnd fall();
    /// Sends nothing for `time`. Then `reply` is the answer to the first packet without force.
    [[nodiscard]] PushEnd pause_sending(std::chrono::milliseconds time, Reply& reply);

    [[nodiscard]] const Reply& last_reply() const noexcept { return reply_; }
    /// Mean counts of about the last 0.1 s of the last hold, however it ended.
    [[nodiscard]] CountsSample held() const noexcept { return held_; }

  private:
    using Clock = std::chrono::steady_clock;

    /// Sends one packet with this part of the force. Ends the force unless the result is `held`.
    PushEnd step(double part);
    PushEnd ramp(double from, double to);
    [[nodiscard]] PushEnd exchange(double part);

    CheckContext& context_;
    Counts motor_;
    std::optional<Vec3> start_m_{};  // where the grip was at the first reply
    Reply reply_{};
    CountsSample held_{};
};

}  // namespace dibhr::falcon
