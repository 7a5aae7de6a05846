// The surface of a tick as plain images, how much of it is recorded, and which part of it an update
// may read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/haptics/vec.hpp"
#include "core/session/tick_record.hpp"
#include "core/session/tile_code.hpp"

namespace dibhr {

/// How much of the felt surface a recording stores.
enum class SurfaceRecording : std::uint8_t {
    tiles,  ///< around the hand
    whole,  ///< all of every touched frame
    off,
};
inline constexpr std::array<NamedValue<SurfaceRecording>, 3> kSurfaceRecordingNames{
    {{SurfaceRecording::tiles, "tiles", "Around the hand"},
     {SurfaceRecording::whole, "whole", "Whole frames"},
     {SurfaceRecording::off, "off", "Off"}}};
static_assert(has_all_in_order(kSurfaceRecordingNames, SurfaceRecording::off));

[[nodiscard]] constexpr const auto& name_table(SurfaceRecording) noexcept {
    return kSurfaceRecordingNames;
}

/// A depth frame, or an in-between.
struct FeltImage {
    std::shared_ptr<const DepthImage> levels{};
    /// Of the same size: 1 where no surface was ever seen. Null: seen all over.
    std::shared_ptr<const std::vector<std::uint8_t>> unseen{};
};

/// The images that a surface blends: the two frames and the in-betweens between them, equally
/// spaced in time, in order; a frame that blends with itself once. All have one size and scale.
struct FeltSurface {
    std::vector<FeltImage> images{};
    /// From the first image to the last; null: not known.
    std::shared_ptr<const MotionField> motion{};
};

/// What an update may have read of a surface.
struct SurfaceRead {
    PlaceBox levels{};
    PlaceBox motion{};  ///< empty: none of it
};

/// How far around a place its elevation and normal are read.
inline constexpr double kNeighbours_px = 2.0;

/// Holds all that an update reads that moved the proxy from `before` to `after` in so many `moves`
/// while the goal was there, without flights that end elsewhere. Each move crosses one TRIANGLE or
/// EDGE, so along an axis it goes one pixel at most: a way that leaves the rectangle of its ends
/// has to come back.
[[nodiscard]] inline PlaceBox read_box(const Vec3& before, const Vec3& after, const Vec3& goal,
                                       int moves) noexcept {
    const auto [left, right] = std::minmax({before.x, after.x, goal.x});
    const auto [top, bottom] = std::minmax({before.y, after.y, goal.y});
    const auto detour = [moves](double begin, double end) {
        return std::max(0.0, moves - std::abs(end - begin)) / 2.0 + kNeighbours_px;
    };
    const double across = detour(before.x, after.x);
    const double down = detour(before.y, after.y);
    return {left - across, top - down, right + across, bottom + down};
}

/// Finds the images that a tick touched, while they are in memory; called by the recorder's thread.
class FeltSurfaces {
  public:
    virtual ~FeltSurfaces() = default;
    /// Nothing: they are not there any more. Images of earlier ticks may be released.
    [[nodiscard]] virtual std::optional<FeltSurface> surface_of(const TickRecord& tick) = 0;
    /// The colour of the surface last given as a small JPEG file; empty: none, or none is due.
    [[nodiscard]] virtual std::string preview() { return {}; }
    /// What every algorithm reads of the surface last given, and one without friction; nothing in a
    /// tick without a surface. To be asked for every tick.
    [[nodiscard]] virtual std::vector<SurfaceRead> read_by_others(
        const TickRecord& /*tick*/, const SessionParameters& /*parameters*/,
        const BumpMap* /*bump*/) {
        return {};
    }
};

/// What a recording stores of the surface. `surfaces` must outlive it; null: nothing.
struct RecordedSurface {
    FeltSurfaces* surfaces{nullptr};
    SurfaceRecording how{SurfaceRecording::tiles};
};

/// The two of `count` images that a tick blends, by their numbers.
struct BlendedImages {
    std::size_t from{0}, to{0};
};

[[nodiscard]] inline BlendedImages blended_images(std::size_t count, double blend) noexcept {
    if (count < 2) return {};
    const double at = std::clamp(blend, 0.0, 1.0) * static_cast<double>(count - 1);
    const auto from = std::min(static_cast<std::size_t>(at), count - 2);
    return {from, from + 1};
}

/// The tiles of an image of columns x rows.
class TileGrid {
  public:
    TileGrid() = default;
    TileGrid(int columns, int rows) noexcept
        : columns_(columns),
          rows_(rows),
          across_((columns + kTileSide - 1) / kTileSide),
          down_((rows + kTileSide - 1) / kTileSide) {}

    [[nodiscard]] int across() const noexcept { return across_; }
    [[nodiscard]] std::size_t count() const noexcept {
        return static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_);
    }

    /// From the first to the last tile, in both directions.
    struct Range {
        int left{0}, top{0}, right{-1}, bottom{-1};

        bool operator==(const Range&) const = default;
    };
    /// The tiles that the box, moved into the image, lies in.
    [[nodiscard]] Range tiles_of(const PlaceBox& box) const noexcept {
        if (box.empty()) return {};
        const auto tile = [](double at, int pixels) {
            return static_cast<int>(at > 0.0 ? std::min(at, pixels - 1.0) : 0.0) / kTileSide;
        };
        return {tile(box.left, columns_), tile(box.top, rows_),
                tile(std::ceil(box.right), columns_), tile(std::ceil(box.bottom), rows_)};
    }
    [[nodiscard]] Range all() const noexcept { return {0, 0, across_ - 1, down_ - 1}; }

    /// Calls visit(place) for each tile of the range: its number, row by row.
    template <typename Visit>
    void visit(const Range& range, Visit&& visit) const {
        for (int j = range.top; j <= range.bottom; ++j)
            for (int i = range.left; i <= range.right; ++i)
                visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(across_) +
                      static_cast<std::size_t>(i));
    }

  private:
    int columns_{0}, rows_{0};
    int across_{0}, down_{0};
};

}  // namespace dibhr
