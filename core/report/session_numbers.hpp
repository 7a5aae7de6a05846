// What a session's ticks come to: contact, forces, speeds, places and what went wrong, in one pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "core/haptics/safety.hpp"
#include "core/report/contact_episodes.hpp"
#include "core/report/distribution.hpp"
#include "core/report/time_line.hpp"
#include "core/report/touched_places.hpp"
#include "core/session/session.hpp"

namespace dibhr {

/// A tick stands for the time until the next one, and for no more than this: a program that was
/// stopped did not touch (as SafetyLimits::max_tick_s, after which there is no force).
inline constexpr double kLongestTick_s = 0.020;
/// A tick that begins so much after its deadline is late: a whole period, as in the loop itself.
inline constexpr double kLate_us = 1000.0;

inline constexpr std::size_t kSafetyCuts = static_cast<std::size_t>(SafetyCut::goal_jump) + 1;

struct TickCounts {
    std::int64_t all{0};
    std::int64_t missing{0};  ///< in the file, between the first and the last
    std::int64_t in_contact{0};
    std::int64_t without_surface{0};
    std::int64_t device_not_ready{0};
    std::int64_t stand_in{0};  ///< the mouse's, for a device that was not ready
    std::int64_t late{0};
    std::int64_t goal_refused{0};
    std::array<std::int64_t, kSafetyCuts> cut{};  ///< by SafetyCut
    double worst_lateness_us{0.0};
};

struct SessionNumbers {
    double begin_utc_s{0.0};  ///< wall time of the first tick since 1970; 0: not known
    double duration_s{0.0};   ///< from the first tick to the end of the last
    double contact_s{0.0};
    TickCounts ticks{};
    std::vector<Episode> episodes{};
    // While in contact.
    Distribution sent_newton{0.001}, spring_newton{0.001};
    Distribution goal_mm_per_s{0.1}, proxy_mm_per_s{0.1};
    TimeLine time_line{0.0, 0.0};
    std::map<std::uint32_t, TouchedPlaces> places{};  ///< by media
    std::map<std::uint64_t, double>
        settings_from_s{};  ///< first use of a version of the parameters

    /// Of all ticks, those in contact: `SELECT avg(contact) FROM tick`.
    [[nodiscard]] double contact_share() const noexcept {
        return ticks.all > 0
                   ? static_cast<double>(ticks.in_contact) / static_cast<double>(ticks.all)
                   : 0.0;
    }
};

/// Reads every tick once and keeps none; `progress` hears the share done from time to time. Throws
/// InputError for a damaged file.
[[nodiscard]] SessionNumbers numbers_of(const Session& session,
                                        const std::function<void(double)>& progress = {});

/// Of the whole session.
[[nodiscard]] double path_mm(const SessionNumbers& numbers);

}  // namespace dibhr
