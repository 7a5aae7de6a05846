// What every frame must be, whatever file it comes of and whatever its levels are said to mean.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>

#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/playing/held_levels_media.hpp"
#include "core/video/sources/media.hpp"
#include "tests/fuzz/entry.hpp"

namespace dibhr::test {

/// As it is decoded. Levels of a meaning may be no data; as recorded only real numbers may, which
/// stand as they are.
inline void require_sound(const RawFrame& frame, const MediaDescription& description) {
    const DepthImage& depth = frame.depth;
    require_rule(depth.columns >= 2 && depth.rows >= 2 &&
                     depth.columns == description.depth_columns &&
                     depth.rows == description.depth_rows &&
                     depth.levels.size() == static_cast<std::size_t>(depth.columns) *
                                                static_cast<std::size_t>(depth.rows),
                 "a frame has the size that was told, and can be touched");
    require_rule(std::isfinite(frame.media_s), "a frame has a time");
    require_rule(
        std::isfinite(static_cast<float>(depth.highest_level)) && depth.highest_level > 0.0,
        "the highest level is a number above 0");
    const bool may_have_holes = description.meaning || description.has_real_numbers();
    const bool has_bounds = description.meaning || !description.has_real_numbers();
    for (const float level : depth.levels) {
        if (may_have_holes && std::isnan(level)) continue;
        require_rule(std::isfinite(level), "a level is a number");
        require_rule(
            !has_bounds || (level >= 0.0F && level <= static_cast<float>(depth.highest_level)),
            "a level is between 0 and the highest");
    }
}

/// As it is touched. Pictures that take the fuzzer's time to clean are left out.
inline void require_touchable(const RawFrame& frame, const MediaDescription& description) {
    constexpr std::size_t kMostPixels = std::size_t{1} << 14U;
    if (frame.depth.levels.size() > kMostPixels) return;
    const CleaningPlan plan{kSensorSteps, {}, {.constant = 0.002F, .square = 0.01F}};
    const Frame cleaned = CleaningChain().clean_and_finish(frame.depth, plan, frame.held);
    const auto highest = static_cast<float>(cleaned.depth->highest_level);
    const bool has_bounds = description.meaning || !description.has_real_numbers();
    for (const float level : cleaned.depth->levels) {
        require_rule(std::isfinite(level), "what is touched is a number everywhere");
        require_rule(!has_bounds || (level >= 0.0F && level <= highest),
                     "what is touched is between 0 and the highest level");
    }
}

/// A few frames, and after a seek a few more, as the player reads them.
inline void require_frames(std::unique_ptr<Media> opened) {
    HeldLevelsMedia media(std::move(opened));
    for (int k = 0; k < 6; ++k) {
        if (k == 3) media.seek(0.5 * media.description().duration_s);
        const auto frame = media.next();
        if (!frame) continue;
        require_sound(*frame, media.description());
        require_touchable(*frame, media.description());
    }
}

}  // namespace dibhr::test
