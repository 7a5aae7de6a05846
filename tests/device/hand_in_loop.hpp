// A mouse hand in a loop: the cursor moved by hand, ticks run, a plain spring as the rendered
// surface.
#pragma once

#include <utility>

#include "device/mouse_hand.hpp"
#include "tests/device/small_relief.hpp"

namespace dibhr::test {

inline constexpr double kPitch_mm = 101.6 / 720.0;

/// Pushes straight up in proportion to the depth below the local surface.
inline Vec3 spring_up(const DepthSurface& surface, Vec3 goal, double stiffness_newton_per_mm) {
    const double depth_px = surface.elevation_at(goal.x, goal.y) - goal.z;
    return {0.0, 0.0, depth_px > 0.0 ? stiffness_newton_per_mm * kPitch_mm * depth_px : 0.0};
}

class HandInLoop {
  public:
    explicit HandInLoop(SmallRelief relief, double stiffness_newton_per_mm = 0.0,
                        double dt_s = 0.001)
        : relief_(std::move(relief)),
          surface_(relief_.surface()),
          stiffness_(stiffness_newton_per_mm),
          dt_s_(dt_s) {}

    HandInLoop(const HandInLoop&) = delete;
    HandInLoop& operator=(const HandInLoop&) = delete;

    MouseTarget cursor{};  ///< published before every tick
    MouseHand hand{};

    HandReading tick() {
        hand.target().publish(cursor);
        const HandReading reading = hand.read({dt_s_, surface_, kPitch_mm});
        hand.send(spring_up(surface_, reading.goal_in_grid, stiffness_));
        return reading;
    }

    HandReading run(double seconds) {
        HandReading reading = tick();
        for (double t = dt_s_; t < seconds; t += dt_s_) reading = tick();
        return reading;
    }

    void point_at(double x, double y) {
        cursor.cursor_in_grid = {x, y};
        cursor.pointing = true;
    }

    [[nodiscard]] const DepthSurface& surface() const { return surface_; }
    [[nodiscard]] double depth_px(Vec3 goal) const {
        return surface_.elevation_at(goal.x, goal.y) - goal.z;
    }

  private:
    SmallRelief relief_;
    DepthSurface surface_;
    double stiffness_;
    double dt_s_;
};

}  // namespace dibhr::test
