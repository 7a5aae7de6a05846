// A frame before what it has to do with those around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// A frame depends on so many before it, and as many after it.
inline constexpr std::size_t kReachInTime = 5;

/// Whether levels of the two can be compared pixel by pixel.
[[nodiscard]] inline bool are_alike(const DepthImage& a, const DepthImage& b) noexcept {
    return a.columns == b.columns && a.rows == b.rows && a.highest_level == b.highest_level;
}

/// A frame cleaned as far as it can be on its own.
struct LoneDepth {
    DepthImage depth{};                   ///< no NaN
    std::vector<std::uint8_t> made_up{};  ///< of its pixels, 1 where there was no data; or empty
    std::vector<std::uint8_t> unseen{};   ///< of its pixels, 1 where nothing ever was; or empty
};

}  // namespace dibhr
