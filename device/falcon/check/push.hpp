// The only place of the check where motors get anything but zero.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "core/haptics/vec.hpp"
#include "device/falcon/check/desk.hpp"
#include "device/falcon/kinematics.hpp"
#include "device/falcon/packet.hpp"
#include "device/hand/check/push.hpp"

namespace dibhr::falcon {

/// Of these counts [m]; nothing when the mechanism has none.
[[nodiscard]] std::optional<Vec3> place_of(Vec3 encoder_counts, const Geometry& geometry);

[[nodiscard]] inline Vec3 as_vec(const Counts& counts) noexcept {
    return {counts[0], counts[1], counts[2]};
}

/// Average of the counts.
struct CountsSample {
    Vec3 mean{0.0};
    int replies{0};
};

/// Counts while the motors get zero, over the second half of the time of a sample: after a force
/// the grip swings back in the first. Throws UsbError when the Falcon gives no replies.
[[nodiscard]] CountsSample sample_counts(CheckDesk& desk);

/// Motor counts that push the grip straight down where it is, `most_counts` on the motor that works
/// hardest. Says so and throws StepSkipped when the mechanism has no place for these counts.
[[nodiscard]] Counts downward(CheckDesk& desk, Vec3 encoder_counts, int most_counts);

/// The force down [N] of these motor counts at this place, for one count a newton metre: to be
/// divided by the torque scale.
[[nodiscard]] std::optional<double> downward_force(const Counts& motor, Vec3 encoder_counts,
                                                   const Geometry& geometry);

/// "1.2 to 3.4 N (120 to 350 g)": how strong that will be by what sources say of the torque scale,
/// and, once it was measured here, by that.
[[nodiscard]] std::string strength_of(const CheckDesk& desk, const Counts& motor,
                                      Vec3 encoder_counts);

/// How a push went.
enum class PushEnd : std::size_t {
    held,        ///< as long as it was wanted
    let_go,      ///< the person pressed a key
    moved_away,  ///< the grip left its place by more than 30 mm
    not_homed,   ///< an axis was not homed any more
    no_reply     ///< the newest reply was older than 20 ms
};

[[nodiscard]] const char* sentence_of(PushEnd end) noexcept;

/// A force on the grip of a homed Falcon, from its rise to its release. Released at once, with five
/// packets without force, when any of it ends otherwise than held, and when this goes out of scope.
class Push : public CheckPush {
  public:
    Push(CheckDesk& desk, const Counts& motor);

    // These throw PersonQuits and UsbError.

    /// From zero to the whole force, in the time of a ramp.
    [[nodiscard]] PushEnd rise();
    /// At most 3 s.
    [[nodiscard]] PushEnd hold(std::chrono::milliseconds time);
    [[nodiscard]] PushEnd fall();
    /// After the last packet nothing is sent for so long; then `reply` is the answer to the first
    /// packet without force.
    [[nodiscard]] PushEnd be_silent(std::chrono::milliseconds time, Reply& reply);

    [[nodiscard]] const Reply& last_reply() const noexcept { return reply_; }
    /// About the last 0.1 s of the last hold, however it ended.
    [[nodiscard]] CountsSample held() const noexcept { return held_; }

  private:
    using Clock = std::chrono::steady_clock;

    /// One packet with this part of the force. Anything but held has released it.
    PushEnd step(double part);
    PushEnd ramp(double from, double to);
    [[nodiscard]] PushEnd exchange(double part);

    CheckDesk& desk_;
    Counts motor_;
    std::optional<Vec3> start_m_{};  // where the grip was at the first reply
    Reply reply_{};
    CountsSample held_{};
};

}  // namespace dibhr::falcon
