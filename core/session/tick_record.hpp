// The data of a session: a tick as it is recorded and read back, plain data that passes through a
// ring; and facts, parameters, sources and marks.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/content_hash.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/realtime/spsc_ring.hpp"

namespace dibhr {

/// Where a tick's depth frames came from: which files, cleaned how.
struct FrameSource {
    std::uint32_t media{0};  ///< number of the opened media, as registered with the recorder
    bool fill_holes{false};
    bool remove_spikes{false};
    bool smooth_steps{false};
    bool sharpen_silhouettes{false};
    bool colour_edges{false};
    bool steady{false};
    bool smooth_noise{false};
    bool densify{false};
    bool smooth_outlines{false};
    bool in_betweens{false};       ///< there are frames between the two of the pair
    bool motion{false};            ///< the motion of the first one is known
    double finger_px{0.0};         ///< the fingertip's radius; 0: a point
    double finger_relief_px{0.0};  ///< for which elevation of the highest level
    std::uint32_t maps{0};         ///< version of the touch maps on them; 0: none

    bool operator==(const FrameSource&) const = default;
};

/// How they were cleaned and what was painted, in the order of the columns of table `source`:
/// visit(name, fact).
template <typename Source, typename Visit>
void visit_cleaning(Source& source, const Visit& visit) {
    visit("fill_holes", source.fill_holes);
    visit("remove_spikes", source.remove_spikes);
    visit("smooth_steps", source.smooth_steps);
    visit("sharpen_silhouettes", source.sharpen_silhouettes);
    visit("colour_edges", source.colour_edges);
    visit("steady", source.steady);
    visit("smooth_noise", source.smooth_noise);
    visit("densify", source.densify);
    visit("smooth_outlines", source.smooth_outlines);
    visit("in_betweens", source.in_betweens);
    visit("motion", source.motion);
    visit("finger_px", source.finger_px);
    visit("finger_relief_px", source.finger_relief_px);
    visit("maps", source.maps);
}

/// Two depth frames that a surface blends: named by their presentation times, which are exact; the
/// numbers are for people.
struct FramePair {
    FrameSource source{};
    std::int64_t from_frame{0}, to_frame{0};  ///< in the file, from 0
    double from_s{0.0}, to_s{0.0};            ///< presentation times in the file
    double span_s{0.0};                       ///< time from the one to the other

    bool operator==(const FramePair&) const = default;
};

/// The images in memory of which a tick's surface was made: identifies them while they are there.
struct SurfaceMark {
    const void* from{nullptr};
    const void* to{nullptr};
    const void* motion{nullptr};
    const void* in_betweens{nullptr};

    bool operator==(const SurfaceMark&) const = default;
};

/// The whole input of a tick, and its result. Grid space [px], newtons, seconds. A number that is
/// not finite is recorded as infinity.
struct TickRecord {
    std::int64_t tick{0};  ///< number of the tick in its loop; one more than the one before
    double t_s{0.0};       ///< monotonic, since the loop began
    /// The steady clock at t_s = 0; 0: the ticks were computed, on no clock. Not read back.
    std::int64_t zero_ns{0};
    double dt_s{0.0};           ///< since the tick before began
    double lateness_us{0.0};    ///< after its deadline
    double update_us{0.0};      ///< time of the update
    std::uint64_t settings{0};  ///< version of the parameters
    /// The device's limits, to which the parameters were lowered; nothing: not lowered. Not read
    /// back: `settings` then is the version of the lowered parameters.
    std::optional<DeviceLimits> limits{};

    FramePair frames{};    ///< means nothing without a surface
    std::int64_t pair{0};  ///< their number in the session, from 1; set by reading back
    SurfaceMark mark{};    ///< likewise; not read back
    double blend{0.0};     ///< 0: from, 1: to
    double utc_s{0.0};     ///< wall time since 1970; set by reading back
    double video_s{0.0};   ///< presentation time of the touched surface; set by reading back

    Vec3 goal{0.0}, proxy{0.0}, spring_newton{0.0}, sent_newton{0.0};
    Vec3 own_newton{0.0};  ///< the device's own force on the hand
    std::int32_t moves{0};
    std::int32_t i{-1}, j{-1};
    bool contact{false};        ///< never without a surface
    std::uint8_t primitive{0};  ///< PrimitiveKind
    std::uint8_t buttons{0};
    std::uint8_t cut{0};  ///< SafetyCut

    bool surface{true};          ///< there was a surface; without, nothing was updated
    bool device_ready{true};     ///< attached and homed
    bool mouse_fallback{false};  ///< the mouse, for a device that was not ready
    bool from_zero{false};       ///< the force began from zero again
    bool releases_contact{
        false};                ///< the hand was lifted or replaced: a contact was released first
    bool goal_refused{false};  ///< the hand's reading was no number: `goal` is the one before
    bool catching_up{false};   ///< the tick ended before the proxy had caught up with its goal
    bool gliding{false};       ///< parameters were gliding to those of `settings`
    bool standstill{false};    ///< window, video or recorder stood still: the force goes to zero
    /// Carrying was on, but the motion between these frames was not known.
    bool motion_unknown{false};
};

/// What "the same" means for recorded reals: every bit, the sign of a zero too.
[[nodiscard]] inline bool same_bits(double a, double b) noexcept {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
[[nodiscard]] inline bool same_bits(const Vec3& a, const Vec3& b) noexcept {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

using TickRing = SpscRing<TickRecord, 16384>;

/// Name/value pairs that describe a session.
using SessionFacts = std::map<std::string, std::string>;

/// A file that was touched, by its absolute path, and its content. Path empty: none; sum empty: the
/// recording ended before the sum was known. The head of a video that was recorded live is not in
/// the sum: the video's length was written there at its end.
using SessionMedia = FileContent;

/// All settings of the user on which the force depends.
struct SessionParameters {
    std::uint64_t version{0};  ///< ticks refer to it
    TouchParameters touch{};
    SafetyLimits limits{};
    bool force_enabled{true};
    SessionMedia bump{};         ///< for writing, the file suffices
    std::int64_t first_tick{0};  ///< set by reading back
};

/// Every number of them, in the order of the columns of table `parameters`: visit(column, number).
template <typename Visit>
void visit_numbers(SessionParameters& parameters, const Visit& visit) {
    for (const TouchNumber& number : touch_numbers())
        visit(number.column, number.in(parameters.touch));
    SafetyLimits& limits = parameters.limits;
    visit(std::string_view("max_force_newton"), limits.max_force_newton);
    visit(std::string_view("max_change_newton_per_ms"), limits.max_change_newton_per_ms);
    visit(std::string_view("ramp_s"), limits.ramp_s);
    visit(std::string_view("max_tick_s"), limits.max_tick_s);
    visit(std::string_view("max_goal_speed_mm_per_ms"), limits.max_goal_speed_mm_per_ms);
    DeviceDynamics& watched = limits.watched;
    visit(std::string_view("watched_mass_kg"), watched.mass_kg);
    visit(std::string_view("watched_friction_newton_s_per_m"), watched.friction_newton_s_per_m);
    visit(std::string_view("watched_resolution_mm"), watched.resolution_mm);
    visit(std::string_view("watched_delay_s"), watched.delay_s);
    visit(std::string_view("watched_margin_newton_s_per_m"), watched.margin_newton_s_per_m);
    visit(std::string_view("max_map_stiffness_newton_per_mm"), limits.max_stiffness_newton_per_mm);
}

/// The files and the cleaning from which frames were made.
struct SessionSource {
    FrameSource source{};
    SessionMedia colour{}, depth{};
    std::int64_t first_tick{0};
    std::string depth_meaning{};  ///< in a sidecar's form (TOML); empty: levels as in the file
};

/// A touch map that was in use, as it is stored in a session.
struct SessionMap {
    std::string kind{};  ///< "stiffness"
    double lowest{0.0};  ///< value of its lowest level; of the highest:
    double highest{1.0};
    std::string png{};  ///< the bytes of its picture
};

/// A moment a person marked while recording.
struct SessionMark {
    double t_s{0.0};  ///< on the ticks' clock
    std::string tag{};
    std::string text{};
};

}  // namespace dibhr
