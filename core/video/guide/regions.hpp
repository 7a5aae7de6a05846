// The named regions of a recording: what each has to say, and which one a place belongs to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/haptics/touch_maps.hpp"

namespace dibhr {

/// Letters of a name and of a text.
inline constexpr std::size_t kMostRegionName = 60;
inline constexpr std::size_t kMostRegionText = 600;

struct Region {
    std::string name{};  ///< "Nose"
    std::string text{};  ///< a sentence or more on it; may be empty

    bool operator==(const Region&) const = default;
};

/// One label picture for the whole recording, or several spread evenly in time for one in which
/// something moves.
struct Regions {
    static constexpr std::size_t kMost = 255;

    int columns{0}, rows{0};     ///< of one label picture, stretched over the depth image
    int pictures{1};             ///< 1 or more
    double pictures_per_s{0.0};  ///< above 0 with several pictures
    /// Picture by picture, row-major: 0 where no region is, else 1 more than its index.
    std::vector<std::uint8_t> labels{};
    std::vector<Region> regions{};  ///< 1 to kMost

    /// The number of the picture at a presentation time; held at both ends.
    [[nodiscard]] int picture_at(double media_s) const noexcept;
    /// 0 outside the picture, too.
    [[nodiscard]] std::uint8_t label(int picture, int i, int j) const noexcept;
    /// The region at (x, y) of a depth image of columns x rows [px]; null: none.
    [[nodiscard]] const Region* at(double x, double y, int image_columns, int image_rows,
                                   double media_s) const noexcept;
};

/// The outlines of the regions in a label picture as ridges, for a finger that follows them: a
/// height map [px] for a depth image of so many columns. Where its width is felt as 101.6 mm they
/// are 0.8 mm high and 1.1 mm wide at half that height.
[[nodiscard]] TouchMap ridges_of(const Regions& regions, int picture, int image_columns);

}  // namespace dibhr
