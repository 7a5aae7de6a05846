// The depth of a frame after the steps of cleaning that need one frame only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/cleaning_options.hpp"

namespace dibhr {

/// A cleaned frame depends on this many frames before it, and as many after it.
inline constexpr std::size_t kReachInTime = 16;
/// Of these so many to each side count one by one, those farther in groups of kGroupInTime.
inline constexpr std::size_t kNearInTime = 5;
inline constexpr std::size_t kGroupInTime = 4;

/// Whether the levels of both can be compared pixel by pixel.
[[nodiscard]] inline bool are_alike(const DepthImage& a, const DepthImage& b) noexcept {
    return a.columns == b.columns && a.rows == b.rows && a.highest_level == b.highest_level;
}

struct SettledDepth;  // cleaning_chain.hpp

/// Depth cleaned by CleaningChain::clean_frame.
struct SingleFrameDepth {
    DepthImage depth{};                  ///< no NaN
    std::vector<std::uint8_t> filled{};  ///< 1 for pixels that had no data; empty: all had data
    std::vector<std::uint8_t> unseen{};  ///< 1 for pixels never seen; empty: all were seen
    std::size_t teeth{0};                ///< of the recorded outlines, if they are smoothed
    CleaningSteps steps{};               ///< of the plan that it was cleaned for
    /// By its time in the media, so that groups of frames are the same however it was reached;
    /// below 0: not known.
    std::int64_t number{-1};
    /// Another one for each frame that clean_frame makes in this process; frames with one id have
    /// the same levels. 0: not known.
    std::uint64_t id{0};
};

}  // namespace dibhr
