// Contact episodes: from the first tick in contact to the last, one tick after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "core/haptics/vec.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

/// Gaps between contacts that are shorter than this belong to one episode: a hand that slides over
/// an edge, not one that came back.
inline constexpr double kJoinedGap_s = 0.020;

/// Whether the tick touched a surface at a known place.
[[nodiscard]] inline bool touches(const TickRecord& tick) noexcept {
    return tick.contact && tick.surface && is_finite(tick.proxy);
}

/// Mean and peak of a force in contact.
struct ForceSummary {
    double mean_newton{0.0};  ///< over time
    double peak_newton{0.0};
};

/// On which kind of primitive the proxy was, as shares of the time in contact.
struct PrimitiveShares {
    double triangle{0.0}, edge{0.0}, vertex{0.0};
};

/// One contact.
struct Episode {
    double begin_s{0.0};    ///< on the ticks' clock, of the first tick in contact
    double end_s{0.0};      ///< when the tick after the last one began
    double contact_s{0.0};  ///< without the gaps inside
    double video_begin_s{0.0}, video_end_s{0.0};  ///< presentation times of what was touched
    std::uint32_t media{0};                       ///< as in FrameSource
    ForceSummary sent{}, spring{};
    double path_mm{0.0};  ///< of the proxy, from tick to tick
    Vec2 centre_px{0.0};  ///< of the proxy's places, by time
    PrimitiveShares shares{};

    [[nodiscard]] double length_s() const noexcept { return end_s - begin_s; }
    /// Along the path, in contact; 0 for a contact of no time.
    [[nodiscard]] double mean_speed_mm_per_s() const noexcept {
        return contact_s > 0.0 ? path_mm / contact_s : 0.0;
    }
};

/// Indices of the episodes, the longest time in contact first.
[[nodiscard]] std::vector<std::size_t> longest_first(const std::vector<Episode>& episodes);

/// An unfinished episode: its means are still sums over time.
struct OpenEpisode {
    Episode episode{};
    std::int64_t last_tick{0};
    Vec3 last_proxy_px{0.0};
};

/// Splits ticks into episodes. One also ends where the hand lets go or the video changes.
class ContactEpisodes {
  public:
    /// A tick that stands for `held_s`, in order of time. `pitch_mm`: size of a pixel.
    void add(const TickRecord& tick, double held_s, double pitch_mm);

    /// All of them, the last one ended.
    [[nodiscard]] std::vector<Episode> finish();

  private:
    void begin(const TickRecord& tick);
    void extend(const TickRecord& tick, double pitch_mm);
    void end();

    std::vector<Episode> episodes_{};
    std::optional<OpenEpisode> open_{};
};

/// Speeds are measured over this time: within 1 ms a device's position steps exceed the motion.
inline constexpr double kSpeedWindow_s = 0.020;

struct Speeds {
    double goal_mm_per_s{0.0};
    double proxy_mm_per_s{0.0};
};

/// Distance between now and kSpeedWindow_s ago, over the time between.
class SpeedWindow {
  public:
    /// Nothing while the window is not filled, or when ticks are missing in it. `pitch_mm`: size
    /// of a pixel.
    [[nodiscard]] std::optional<Speeds> add(const TickRecord& tick, double pitch_mm);

  private:
    struct Place {
        double t_s{0.0};
        Vec3 goal_px{0.0};
        Vec3 proxy_px{0.0};
    };
    std::deque<Place> places_{};  ///< the oldest first; all within the window but the first
};

}  // namespace dibhr
