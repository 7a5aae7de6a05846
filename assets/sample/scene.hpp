// The whole sample scene at one frame: which part is where, and how far.
#pragma once

#include <array>
#include <cstdint>

#include "assets/sample/hand.hpp"
#include "assets/sample/pose.hpp"
#include "assets/sample/sdf.hpp"

namespace dibhr::sample {

enum class Part : std::uint8_t { Face, Eye, Hair, Sweater, Sleeve, Hand, Wall };

/// A set of parts, one bit each.
using Parts = std::uint32_t;
[[nodiscard]] constexpr Parts bit(Part part) noexcept {
    return 1U << static_cast<unsigned>(part);
}

class Scene {
  public:
    explicit Scene(const Pose& pose);

    [[nodiscard]] const Pose& pose() const noexcept { return pose_; }
    [[nodiscard]] const Fingers& fingers() const noexcept { return fingers_; }
    [[nodiscard]] Vec3 to_head(Vec3 world) const noexcept;
    [[nodiscard]] Vec3 to_hand(Vec3 world) const noexcept;

    /// Parts that a ray along z may meet within `margin` px of this place.
    [[nodiscard]] Parts parts_near(Vec2 place, float margin) const noexcept;

    /// Distance to one part [px].
    [[nodiscard]] float distance(Vec3 world, Part part) const noexcept;
    /// Distance to the nearest of these parts; the wall is not one of them.
    [[nodiscard]] float distance(Vec3 world, Parts parts) const noexcept;
    [[nodiscard]] Part nearest(Vec3 world, Parts parts) const noexcept;
    /// Outward, of length 1.
    [[nodiscard]] Vec3 normal(Vec3 world, Part part) const noexcept;

    /// Of the wall behind the person: everywhere nearer than 0, so nowhere is there a bottomless
    /// void; a whole level, since in the light the steps of a curved wall would show.
    static constexpr float kWallLevel = 20.0F;

  private:
    struct Rectangle {
        Vec2 low{}, high{};
    };
    Pose pose_;
    Fingers fingers_;
    Vec3 forearm_{};  // from wrist to elbow in the hand's frame, length 1
    std::array<Rectangle, 6> bounds_{};
};

}  // namespace dibhr::sample
