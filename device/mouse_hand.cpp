// The mouse as a virtual hand: a mass on a spring to the cursor, pushed back by the rendered force.
#include "device/mouse_hand.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace dibhr {

namespace {

constexpr double kLongestTick_s = 0.1;    // a longer one (a debugger) is cut to this
constexpr double kMostWheel_px = 200.0;   // any deeper, the force is at its limit anyway
constexpr double kReached_px = 5.0;       // pressing begins at this distance to the cursor
constexpr double kBeyondFrame_px = 40.0;  // how far a pressing hand may leave the image
constexpr int kLookAhead = 8;             // places checked between a hovering hand and the cursor
constexpr double kStill_px = 0.01;        // from its anchor, a hand that rests
constexpr double kStill_px_per_s = 0.1;   // likewise

bool sensible(const MouseTarget& target) noexcept {
    return std::isfinite(target.cursor_in_grid.x) && std::isfinite(target.cursor_in_grid.y) &&
           std::isfinite(target.wheel_px);
}

/// The cursor, at most `margin_px` outside the image rectangle.
Vec2 within_frame(Vec2 cursor, const DepthSurface& surface, double margin_px) noexcept {
    const Vec2 last{surface.columns() - 1, surface.rows() - 1};
    return glm::clamp(cursor, Vec2{-margin_px}, last + margin_px);
}

/// The highest of a few places on the way from `from` to `to`, both ends included.
double highest_between(const DepthSurface& surface, Vec2 from, Vec2 to) noexcept {
    double highest = surface.elevation_at(from.x, from.y);
    for (int k = 1; k <= kLookAhead; ++k) {
        const Vec2 place = from + (to - from) * (static_cast<double>(k) / kLookAhead);
        highest = std::max(highest, surface.elevation_at(place.x, place.y));
    }
    return highest;
}

}  // namespace

MouseHand::MouseHand(MouseHandOptions options) : options_(options), depth_px_(-options.hover_px) {
    specification_.name = "mouse";
    specification_.limits = kVirtualHandLimits;
}

HandReading MouseHand::read(const HandContext& context) noexcept {
    const double dt_s = context.dt_s > 0.0 ? std::min(context.dt_s, kLongestTick_s) : 0.0;
    take_target(context.surface);
    press(dt_s);
    const Vec3 anchor = anchor_in_grid(context.surface);
    if (!placed_) {
        position_in_grid_ = anchor;
        placed_ = true;
    }
    const Vec3 before = position_in_grid_;
    move(anchor, dt_s, context.pixel_pitch_mm);
    if (!pressing_) keep_clear_of_cliffs(context.surface, before);
    resting_ = !valid_target_.pressed && glm::length(velocity_px_per_s_) < kStill_px_per_s &&
               glm::distance(position_in_grid_, anchor) < kStill_px;

    HandReading reading;
    reading.goal_in_grid = position_in_grid_;
    reading.buttons = valid_target_.pressed ? 1 : 0;
    // The cursor may leave the surface on a path that no proxy can follow, as from under a chin.
    reading.lifted =
        !pressing_ && position_in_grid_.z >
                          context.surface.elevation_at(position_in_grid_.x, position_in_grid_.y);
    return reading;
}

void MouseHand::send(Vec3 force_newton) noexcept {
    force_newton_ = is_finite(force_newton) ? force_newton : Vec3{0.0};
}

void MouseHand::take_target(const DepthSurface& surface) noexcept {
    const MouseTarget& newest = target_.front();
    if (sensible(newest)) valid_target_ = newest;
    const Vec2 cursor = within_frame(valid_target_.cursor_in_grid, surface, 0.0);
    const bool reached = glm::distance(cursor, Vec2(position_in_grid_)) <= kReached_px;
    pressing_ = valid_target_.pointing && valid_target_.pressed && (pressing_ || reached);
}

void MouseHand::press(double dt_s) noexcept {
    depth_px_ = pressing_
                    ? std::min(depth_px_ + options_.press_px_per_s * dt_s, options_.deepest_px)
                    : -options_.hover_px;
}

Vec3 MouseHand::anchor_in_grid(const DepthSurface& surface) const noexcept {
    if (!valid_target_.pointing) {
        return {0.5 * (surface.columns() - 1), 0.5 * (surface.rows() - 1),
                surface.ceiling() + options_.hover_px};
    }
    const Vec2 hand{position_in_grid_};
    if (pressing_) {
        const Vec2 cursor = within_frame(valid_target_.cursor_in_grid, surface, kBeyondFrame_px);
        const double depth = depth_px_ + std::clamp(valid_target_.wheel_px, 0.0, kMostWheel_px);
        return {cursor, surface.elevation_at(hand.x, hand.y) - depth};
    }
    const Vec2 cursor = within_frame(valid_target_.cursor_in_grid, surface, 0.0);
    const double highest = std::max(highest_between(surface, hand, cursor), obstacle_px_);
    return {cursor, highest + options_.hover_px};
}

// m a = h (anchor - x) - b v + f, by one step of backward Euler in h and b: damped for any length
// of the tick. The rendered force f is that of the last tick, so this loop is stable only while
// K dt < 4 m / dt + 2 b + h dt (Jury's criterion): 2 N/mm in ticks of 20 ms leave a factor of two.
void MouseHand::move(Vec3 anchor, double dt_s, double pixel_pitch_mm) noexcept {
    if (!(dt_s > 0.0) || !(pixel_pitch_mm > 0.0)) return;
    const double px_per_m = 1000.0 / pixel_pitch_mm;
    const double mass = options_.mass_kg;
    const double stiffness = 1000.0 * options_.hand_stiffness_newton_per_mm;
    const double damping = 2.0 * options_.damping_ratio * std::sqrt(stiffness * mass);

    // Only a pressing hand feels the force: with the button up, it leaves the surface freely.
    const Vec3 rendered_newton = pressing_ ? force_newton_ : Vec3{0.0};
    const Vec3 push = stiffness * (anchor - position_in_grid_) + rendered_newton * px_per_m;
    velocity_px_per_s_ = (mass * velocity_px_per_s_ + dt_s * push) /
                         (mass + dt_s * damping + dt_s * dt_s * stiffness);
    const double fastest = options_.max_speed_mm_per_s / pixel_pitch_mm;
    const double speed = glm::length(velocity_px_per_s_);
    if (speed > fastest) velocity_px_per_s_ *= fastest / speed;
    position_in_grid_ += dt_s * velocity_px_per_s_;
}

// Holds the hand beside a place that is still too high to pass over, while the spring lifts it. The
// elevation of that place is kept, because the few places checked ahead may all miss it.
void MouseHand::keep_clear_of_cliffs(const DepthSurface& surface, Vec3 before) noexcept {
    const double clearance = options_.hover_px / 3.0;
    const double here = surface.elevation_at(before.x, before.y);
    double below = surface.elevation_at(position_in_grid_.x, position_in_grid_.y);
    obstacle_px_ = below;
    if (below > here && position_in_grid_.z < below + clearance) {
        position_in_grid_ = {before.x, before.y, position_in_grid_.z};
        velocity_px_per_s_ = {0.0, 0.0, velocity_px_per_s_.z};
        below = here;
    }
    const double floor = std::min(before.z, below + clearance);
    if (position_in_grid_.z < floor) {  // still sinking from somewhere higher
        position_in_grid_.z = floor;
        velocity_px_per_s_.z = 0.0;
    }
}

}  // namespace dibhr
