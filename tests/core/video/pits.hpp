// What is felt of holes: pits, and whether a finger at rest stays in contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "tests/support/pressing_finger.hpp"

namespace dibhr::test {

inline constexpr double kRelief_px = 255.0;  ///< of the highest level

inline double elevation_px(const DepthImage& image, std::size_t pixel) {
    return kRelief_px * static_cast<double>(image.levels[pixel]) / image.highest_level;
}

enum class Pits { all, in_holes };

/// Pixels more than 5 px below every neighbour within 10 px that has data in `raw`: all, or those
/// that have none themselves. A camera may measure what looks like a pit.
inline int count_pits(const DepthImage& raw, const DepthImage& cleaned, Pits which = Pits::all) {
    constexpr int kReach = 10;
    constexpr double kDeep_px = 5.0;
    const auto is_pit = [&](int i, int j) {
        const double rim_px = elevation_px(cleaned, raw.index(i, j)) + kDeep_px;
        bool near_data = false;
        for (int y = std::max(j - kReach, 0); y <= std::min(j + kReach, raw.rows - 1); ++y)
            for (int x = std::max(i - kReach, 0); x <= std::min(i + kReach, raw.columns - 1); ++x) {
                const int away = (x - i) * (x - i) + (y - j) * (y - j);
                if (away == 0 || away > kReach * kReach || std::isnan(raw.at(x, y))) continue;
                if (elevation_px(cleaned, raw.index(x, y)) <= rim_px) return false;
                near_data = true;
            }
        return near_data;
    };
    int pits = 0;
    for (int j = 0; j < raw.rows; ++j)
        for (int i = 0; i < raw.columns; ++i) {
            const bool counts = which == Pits::all || std::isnan(raw.at(i, j));
            pits += counts && is_pit(i, j) ? 1 : 0;
        }
    return pits;
}

/// The share of the time in which a finger at rest is below the surface: at `pixel`, over frames
/// `frame_s` apart.
inline double contact_share(const std::vector<DepthImage>& frames, std::size_t pixel,
                            double frame_s) {
    PressingFinger finger(elevation_px(frames.front(), pixel), kRestTimeConstant_s);
    int in_contact = 0;
    int steps = 0;
    for (std::size_t k = 0; k + 1 < frames.size(); ++k)
        for (double t_s = 0.0; t_s < frame_s; t_s += kFingerTick_s, ++steps) {
            const double from_px = elevation_px(frames[k], pixel);
            const double to_px = elevation_px(frames[k + 1], pixel);
            const double z_px = from_px + t_s / frame_s * (to_px - from_px);
            in_contact += z_px > finger.follow(z_px) ? 1 : 0;
        }
    return static_cast<double>(in_contact) / steps;
}

}  // namespace dibhr::test
