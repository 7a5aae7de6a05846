// The mouse as a virtual hand: a mass on a spring to the cursor, pushed back by the rendered force.
#include "device/mouse_hand.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dibhr {

namespace {

constexpr double kLongestTick_s = 0.1;    // a longer one (a debugger) is cut to this
constexpr double kMostWheel_px = 200.0;   // any deeper, the force is at its limit anyway
constexpr double kReached_px = 5.0;       // pressing begins at this distance to the cursor
constexpr double kBeyondFrame_px = 40.0;  // how far a pressing hand may leave the image
constexpr int kLookAhead = 8;             // places checked between a hovering hand and the cursor
constexpr double kStill_px = 0.01;        // from its anchor, a hand that rests
constexpr double kStill_px_per_s = 0.1;   // likewise

// A click.
constexpr double kLeastFelt_s = 0.020;     // a press is felt after so long below the surface
constexpr double kLongestTap_s = 0.5;      // a press that cannot be felt, as over a hole, ends then
constexpr double kLongestLifting_s = 0.3;  // a hand that cannot leave the surface presses then
constexpr double kLongestWay_s = 0.15;     // to the place of a click, which a force may stop

// A climb.
constexpr double kStopped_s = 0.010;       // a proxy that stands so long at a wall is stopped
constexpr double kStands_px_per_s = 20.0;  // slower than this it stands
constexpr double kLeastAhead_px = 2.0;     // how far the goal of a stopped proxy is ahead
constexpr double kWallWithin_px = 4.0;     // the wall is so near to the proxy that it stops
constexpr double kLeastRise_px = 4.0;  // lower walls are texture; of slopes of 45 degrees or more
constexpr double kOver_px = 1.0;       // a climb ends so high above the surface
constexpr int kMostPlaces = 64;        // looked at on the way to the goal

bool is_finite(Vec2 place) noexcept {
    return std::isfinite(place.x) && std::isfinite(place.y);
}

bool sensible(const MouseTarget& target) noexcept {
    return is_finite(target.cursor_in_grid) && std::isfinite(target.wheel_px);
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
    take_target(context.surface, dt_s);
    press(dt_s);
    look_ahead(context, dt_s);
    const Vec3 anchor = anchor_in_grid(context.surface);
    if (!placed_) {
        position_in_grid_ = anchor;
        placed_ = true;
    }
    const Vec3 before = position_in_grid_;
    move(anchor, dt_s, context.pixel_pitch_mm);
    if (!pressing_) keep_clear(context, before, dt_s);
    climb(context, before.z, dt_s);
    const bool above = is_above(context.surface);
    if (pressing_ && !above) felt_s_ += dt_s;
    clear_ = above && !pressing_;
    resting_ = !valid_target_.pressed && !next_click_ && clicks_.size() == 0 &&
               glm::length(velocity_px_per_s_) < kStill_px_per_s &&
               glm::distance(position_in_grid_, anchor) < kStill_px;

    HandReading reading;
    reading.goal_in_grid = position_in_grid_;
    reading.buttons = valid_target_.pressed ? 1 : 0;
    // The cursor may leave the surface on a path that no proxy can follow, as from under a chin or
    // up a wall.
    reading.lifted = above && (!pressing_ || climb_);
    reading.harmless = true;
    return reading;
}

void MouseHand::send(Vec3 force_newton) noexcept {
    force_newton_ = is_finite(force_newton) ? force_newton : Vec3{0.0};
}

void MouseHand::take_target(const DepthSurface& surface, double dt_s) noexcept {
    button_s_ += dt_s;
    on_the_way_s_ -= dt_s;
    const MouseTarget& newest = target_.front();
    MouseClick click;
    if (!next_click_ && clicks_.pop(click)) {
        if (!is_finite(click.cursor_in_grid)) click = {valid_target_.cursor_in_grid, false, 0.0};
        next_click_ = click;
        const double way = glm::distance(click.cursor_in_grid, valid_target_.cursor_in_grid);
        on_the_way_s_ = way > kReached_px ? kLongestWay_s : 0.0;
    }
    if (next_click_) {
        valid_target_.cursor_in_grid = next_click_->cursor_in_grid;
        valid_target_.pointing = true;
        if (may_take(*next_click_, surface)) {
            valid_target_.pressed = next_click_->pressed;
            button_s_ = felt_s_ = 0.0;
            ++clicks_taken_;
            next_click_.reset();
        }
    } else if (newest.clicks == clicks_taken_ && sensible(newest)) {
        if (newest.pressed != valid_target_.pressed) button_s_ = felt_s_ = 0.0;
        valid_target_ = newest;
    }
    const Vec2 cursor = within_frame(valid_target_.cursor_in_grid, surface, 0.0);
    const bool reached = glm::distance(cursor, Vec2(position_in_grid_)) <= kReached_px;
    pressing_ = valid_target_.pointing && valid_target_.pressed && (pressing_ || reached);
}

/// Whether the button may go up or down now: each press is felt, and as long as it was; between two
/// of them the hand leaves the surface.
bool MouseHand::may_take(const MouseClick& click, const DepthSurface& surface) const noexcept {
    if (click.pressed == valid_target_.pressed) return true;
    if (click.pressed) return is_above(surface) || button_s_ > kLongestLifting_s;
    const bool there = on_the_way_s_ <= 0.0 ||
                       glm::distance(click.cursor_in_grid, Vec2(position_in_grid_)) <= kReached_px;
    const bool felt = felt_s_ >= kLeastFelt_s || button_s_ > kLongestTap_s;
    return there && felt && button_s_ >= std::min(click.after_s, kLongestTap_s);
}

void MouseHand::forget_clicks() noexcept {
    for (MouseClick click; clicks_.pop(click);) ++clicks_taken_;
    if (next_click_) ++clicks_taken_;
    next_click_.reset();
    valid_target_.pressed = false;
}

void MouseHand::press(double dt_s) noexcept {
    depth_px_ =
        pressing_
            ? std::min(std::max(depth_px_, options_.first_px) + options_.press_px_per_s * dt_s,
                       options_.deepest_px)
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
        const double below = surface.elevation_at(hand.x, hand.y);
        // Behind an edge the hand waits for the proxy: pressed down, it would hold it there.
        return {cursor, (over_edge_ ? std::max(contact_->z, below) : below) - depth};
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

/// What lies between the proxy and the hand.
MouseHand::Way MouseHand::way_to_hand(const HandContext& context) const noexcept {
    const Vec2 proxy{*context.contact};
    const Vec2 ahead = Vec2(position_in_grid_) - proxy;
    Way way{.length_px = glm::length(ahead)};
    if (way.length_px < kLeastAhead_px) return way;
    way.moved_px = glm::dot(proxy - Vec2(*contact_), ahead) / way.length_px;
    const double step = std::max(1.0, way.length_px / kMostPlaces);
    double last = context.surface.elevation_at(proxy.x, proxy.y);
    for (double at = step; at <= way.length_px; at += step) {
        const Vec2 place = proxy + ahead * (at / way.length_px);
        const double here = context.surface.elevation_at(place.x, place.y);
        way.begins_steep = way.begins_steep || (at - step < kWallWithin_px && here - last > step);
        way.falls = way.falls || last - here > step + kLeastRise_px;
        way.top_px = std::max(way.top_px, here);
        last = here;
    }
    return way;
}

/// Looks at the way from the proxy to the hand, and counts how long a wall has stopped the proxy.
void MouseHand::look_ahead(const HandContext& context, double dt_s) noexcept {
    const bool touches = pressing_ && contact_ && context.contact;
    const Way way = touches ? way_to_hand(context) : Way{};
    over_edge_ = way.falls && !way.begins_steep;
    const bool stopped = way.begins_steep && way.moved_px < kStands_px_per_s * dt_s &&
                         way.top_px > context.contact->z + kLeastRise_px;
    stopped_s_ = stopped ? stopped_s_ + dt_s : 0.0;
    contact_ = context.contact;
}

/// Lifts the hand over the surface below it, where a wall has stopped the proxy. The contact is
/// released in the tick that ends above the surface; after that the hand presses again.
void MouseHand::climb(const HandContext& context, double before_px, double dt_s) noexcept {
    if (!pressing_ || !contact_) climb_.reset();
    if (!pressing_ || !(context.pixel_pitch_mm > 0.0)) return;
    if (!climb_ && stopped_s_ < kStopped_s) return;
    if (!climb_) climb_ = Climb{before_px, before_px, before_px};
    const double here = context.surface.elevation_at(position_in_grid_.x, position_in_grid_.y);
    climb_->to_px = std::max(climb_->to_px, here + kOver_px);
    climb_->age_s += dt_s;
    const double share = std::min(climb_->age_s / kClimb_s, 1.0);
    const double rise = share * share * (3.0 - 2.0 * share);  // soft at both ends
    const double wanted = climb_->from_px + (climb_->to_px - climb_->from_px) * rise;
    const double fastest = options_.max_speed_mm_per_s / context.pixel_pitch_mm * dt_s;
    climb_->at_px = std::clamp(wanted, climb_->at_px, climb_->at_px + fastest);
    position_in_grid_.z = climb_->at_px;
    velocity_px_per_s_.z = 0.0;
}

// Holds the hand beside a place that is still too high to pass over, while the spring lifts it. The
// elevation of that place is kept, because the few places checked ahead may all miss it. A surface
// that rises, as that of a video does, takes a hand along that was clear of it.
void MouseHand::keep_clear(const HandContext& context, Vec3 before, double dt_s) noexcept {
    const DepthSurface& surface = context.surface;
    const double clearance = options_.hover_px / 3.0;
    const double here = surface.elevation_at(before.x, before.y);
    double below = surface.elevation_at(position_in_grid_.x, position_in_grid_.y);
    obstacle_px_ = below;
    if (below > here && position_in_grid_.z < below + clearance) {
        position_in_grid_ = {before.x, before.y, position_in_grid_.z};
        velocity_px_per_s_ = {0.0, 0.0, velocity_px_per_s_.z};
        below = here;
    }
    const double fastest_px = clear_ && context.pixel_pitch_mm > 0.0
                                  ? options_.max_speed_mm_per_s / context.pixel_pitch_mm * dt_s
                                  : 0.0;
    const double floor = std::min(before.z + fastest_px, below + clearance);
    if (position_in_grid_.z < floor) {  // sinking from somewhere higher, or overtaken
        position_in_grid_.z = floor;
        velocity_px_per_s_.z = 0.0;
    }
}

}  // namespace dibhr
