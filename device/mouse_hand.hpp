// The mouse as a virtual hand: a mass on a spring to the cursor, pushed back by the rendered force.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/loop/device.hpp"
#include "core/realtime/spsc_ring.hpp"
#include "core/realtime/triple_buffer.hpp"

namespace dibhr {

/// Where the cursor points, written by the window thread.
struct MouseTarget {
    Vec2 cursor_in_grid{0.0};
    bool pointing{false};     ///< the cursor has been over the relief
    bool pressed{false};      ///< left button: press in; the longer, the deeper
    double wheel_px{0.0};     ///< depth added by the wheel while pressed [px], >= 0
    std::uint64_t clicks{0};  ///< of the ring, which were pushed before it
};

/// The left button went down or up.
struct MouseClick {
    Vec2 cursor_in_grid{0.0};
    bool pressed{false};
    double after_s{0.0};  ///< since the click before: a press lasts at least that long
};

/// Written by the window thread, some of them long after they happened, but in their order.
using MouseClicks = SpscRing<MouseClick, 256>;

/// How the virtual hand moves. Its spring and the rendered spring act in series: on a surface as
/// stiff as the hand, the goal stays at half the depth of the hand's anchor.
struct MouseHandOptions {
    double hover_px{6.0};         ///< height above the surface while the button is up
    double first_px{4.0};         ///< depth of the anchor when the button goes down
    double press_px_per_s{60.0};  ///< how fast the anchor sinks while the button is held
    double deepest_px{40.0};      ///< its greatest depth; the wheel adds to it
    double mass_kg{0.17};         ///< with the stiffness: 1/w = 18 ms, the cursor leads by 37 ms
    double hand_stiffness_newton_per_mm{0.5};
    double damping_ratio{1.0};  ///< 1: critical
    /// Below the 10 m/s at which the safety stage takes a motion for a jump of the goal.
    double max_speed_mm_per_s{3000.0};
};

/// Follows the cursor over the surface. Stable for ticks up to 20 ms against 2 N/mm,
/// and up to 10 ms against 10 N/mm.
///
/// A hovering hand first rises, then moves on, so that it does not run into a cliff; a surface that
/// rises takes it along. Pressing begins when the hand has reached the cursor. From then on the
/// depth is measured from the surface under the hand itself, so that a drag across a cliff does not
/// press into the cliff.
///
/// A press lasts until it was felt, however short the click was. Where a wall stops the proxy of a
/// pressing hand, the hand climbs it as a finger would: it rises over the surface within kClimb_s,
/// takes the proxy along, and presses again.
class MouseHand final : public Device {
  public:
    /// Time of a climb up a step that the hand's speed allows [s].
    static constexpr double kClimb_s = 0.060;

    explicit MouseHand(MouseHandOptions options = {});
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    /// Until the cursor has been over the relief, the hand waits above the middle of the image,
    /// higher than the relief.
    HandReading read(const HandContext& context) noexcept override;
    /// The button is up, and the hand stands where the cursor points.
    [[nodiscard]] bool rests() const noexcept override { return resting_; }
    /// A force that is not finite counts as none.
    void send(Vec3 force_newton) noexcept override;

    /// Written by the window thread.
    [[nodiscard]] TripleBuffer<MouseTarget>& target() noexcept { return target_; }
    /// Written by the window thread; push a click before the target that counts it.
    [[nodiscard]] MouseClicks& clicks() noexcept { return clicks_; }

    /// Of the haptic thread, when the mouse becomes the hand: clicks of before move nothing.
    void forget_clicks() noexcept;

  private:
    struct Way {
        double length_px{0.0};
        double moved_px{0.0};  // the proxy, towards the hand
        double top_px{-std::numeric_limits<double>::infinity()};
        bool begins_steep{false};  // it rises by 45 degrees or more right before the proxy
        bool falls{false};         // steeply, somewhere
    };
    struct Climb {
        double from_px{0.0}, to_px{0.0}, at_px{0.0};  // elevations of the goal
        double age_s{0.0};
    };

    void take_target(const DepthSurface& surface, double dt_s) noexcept;
    [[nodiscard]] bool may_take(const MouseClick& click,
                                const DepthSurface& surface) const noexcept;
    void press(double dt_s) noexcept;
    /// `before_px`: the goal's elevation in the last tick.
    void climb(const HandContext& context, double before_px, double dt_s) noexcept;
    [[nodiscard]] Way way_to_hand(const HandContext& context) const noexcept;
    void look_ahead(const HandContext& context, double dt_s) noexcept;
    [[nodiscard]] bool is_above(const DepthSurface& surface) const noexcept {
        return position_in_grid_.z > surface.elevation_at(position_in_grid_.x, position_in_grid_.y);
    }
    /// Where the hand's spring pulls it.
    [[nodiscard]] Vec3 anchor_in_grid(const DepthSurface& surface) const noexcept;
    void move(Vec3 anchor, double dt_s, double pixel_pitch_mm) noexcept;
    /// `before`: the goal in the last tick.
    void keep_clear(const HandContext& context, Vec3 before, double dt_s) noexcept;

    DeviceSpecification specification_{};
    MouseHandOptions options_{};
    TripleBuffer<MouseTarget> target_{};
    MouseClicks clicks_{};

    // Used by the haptic thread only.
    MouseTarget valid_target_{};  // the newest one with finite values
    Vec3 position_in_grid_{0.0};
    Vec3 velocity_px_per_s_{0.0};
    Vec3 force_newton_{0.0};
    double depth_px_{0.0};  // of the anchor, below the surface; -hover_px while the button is up
    // Elevation of the last place that the hovering hand was to pass over.
    double obstacle_px_{-std::numeric_limits<double>::infinity()};
    std::optional<MouseClick> next_click_{};
    std::uint64_t clicks_taken_{0};
    double button_s_{0.0};      // how long the button has been as it is
    double felt_s_{0.0};        // of this press: how long the goal was below the surface
    double on_the_way_s_{0.0};  // left to come to the place of the next click
    std::optional<Climb> climb_{};
    std::optional<Vec3> contact_{};  // of the last tick
    bool over_edge_{false};          // the hand is behind an edge on which the proxy still lies
    double stopped_s_{0.0};          // how long a wall has stopped the proxy
    bool pressing_{false};
    bool clear_{false};  // the hovering hand was above the surface in the last tick
    bool placed_{false};
    bool resting_{false};
};

}  // namespace dibhr
