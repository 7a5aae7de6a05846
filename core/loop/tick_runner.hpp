// The computation of one tick, which the loop, a replay, `dibhr touch` and a study's pilot share:
// newest surface and parameters -> proxy -> spring force -> safe force.
#pragma once

#include <chrono>

#include "core/haptics/parameter_glide.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/touch.hpp"
#include "core/haptics/vec.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/motion/motion_track.hpp"

namespace dibhr {

/// The input of a tick, besides the parameters and the ticks before it.
struct TickInput {
    DepthBlend pair{};             ///< two frames that make a surface
    const BumpMap* bump{nullptr};  ///< laid over that surface; null: none
    Vec3 goal{0.0};                ///< [px], grid space; not finite: refused
    SafetyInput safety{};          ///< with the length of the tick
    bool releases_contact{false};  ///< the hand was lifted or replaced: a contact is released first
    /// The parameters do not glide. Nor do they where the force begins from zero.
    bool at_once{false};
    /// The motion between the two frames is left out: it was not known when they were recorded.
    bool motion_unknown{false};
};

/// Runs ticks one after the other. No tick allocates, locks, waits or throws.
class TickRunner {
  public:
    /// One tick; `target`: where the parameters are, or glide to.
    const Touch& run(const TickInput& input, const ParameterGlide::Values& target) noexcept;

    /// A tick without a surface, with zero force: the next force begins from zero. Returns the last
    /// touch without its forces.
    const Touch& pause() noexcept;
    /// Back to the state before the first tick. The next force must begin from zero.
    void reset() noexcept;
    /// The proxy, in contact or not, begins above the next goal.
    void release_contact() noexcept { renderer_.release_contact(); }

    /// The parameters and limits of the last tick, which may still glide to the target.
    [[nodiscard]] const ParameterGlide::Values& effective_values() const noexcept {
        return glide_.now();
    }
    /// Carrying was on, but the motion between the two frames was not known.
    [[nodiscard]] bool lacks_motion() const noexcept { return lacks_motion_; }
    /// What carried the proxy, and the material point under it.
    [[nodiscard]] const TouchRenderer& renderer() const noexcept { return renderer_; }
    /// How long the proxy and the force took; 0 after pause().
    [[nodiscard]] std::chrono::steady_clock::duration update_time() const noexcept {
        return update_time_;
    }

    /// The row of the last tick's input in a session, without its time, its settings and the fields
    /// that only the loop sets.
    [[nodiscard]] TickRecord record_of(const TickInput& input) const noexcept;

  private:
    TouchRenderer renderer_{};
    MotionTrack track_{};
    ParameterGlide glide_{};
    Touch touch_{};
    std::chrono::steady_clock::duration update_time_{};
    bool lacks_motion_{false};
};

/// Adds a tick's result to the row of its input.
void add_result(TickRecord& row, const Touch& touch) noexcept;

}  // namespace dibhr
