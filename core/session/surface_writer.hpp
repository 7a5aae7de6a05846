// Stores the surface that ticks felt, tile by tile, in their session.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/session/felt_surface.hpp"
#include "core/session/tick_record.hpp"
#include "core/session/tile_code.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

/// A tile is stored once for each image, and its content once for as many images as have it. One
/// thread at a time; every call that writes throws DatabaseError, and needs a transaction.
class SurfaceWriter {
  public:
    /// How far around what was read the surface is stored: other friction leads the proxy
    /// elsewhere.
    static constexpr double kMargin_px = 4.0;

    /// `database` and `surfaces` must outlive it.
    SurfaceWriter(const Database& database, FeltSurfaces& surfaces, SurfaceRecording how);

    /// The next ticks are over the pair of that number, as the tick is.
    void begin(std::int64_t pair, const TickRecord& tick);
    /// Notes what the tick may have read, and what other algorithms would have; for every tick.
    /// `parameters`, `bump`: the tick's; null: not known, none.
    void add(const TickRecord& tick, const SessionParameters* parameters, const BumpMap* bump);
    /// Writes what was noted and is not in the file.
    void flush();
    /// The whole bump map, for that file.
    void add_bump(std::int64_t media, const std::shared_ptr<const BumpMap>& bump);

    /// Pairs whose images were not in memory any more: nothing of them is stored.
    [[nodiscard]] std::uint64_t missing() const noexcept { return missing_; }

  private:
    /// An image of numbers, of which tiles are wanted and written.
    struct Grid {
        enum class State : std::uint8_t { absent, wanted, written };

        std::shared_ptr<const void> data{};
        /// Reads pixels of `data` which follow each other, the k-th first.
        std::function<void(std::size_t k, std::span<float> pixels)> read{};
        std::int64_t id{0};
        int columns{0}, rows{0};
        TileGrid tiles{};
        std::vector<State> states{};
        bool pending{false};  ///< a tile is wanted

        void want(const TileGrid::Range& range);
    };
    using SharedGrid = std::shared_ptr<Grid>;
    struct Part {
        SharedGrid levels{}, unseen{};
    };

    /// The grid of that data: the pair before may have had it.
    template <typename Data, typename Value>
    [[nodiscard]] SharedGrid grid_of(const std::shared_ptr<const Data>& data, int columns, int rows,
                                     Value value);
    [[nodiscard]] Part part_of(const FeltImage& image);
    void want(const SurfaceRead& read, double blend);
    void take_motion(const std::shared_ptr<const MotionField>& motion);
    void write_tiles(Grid& grid);
    [[nodiscard]] std::int64_t tile_id(const Tile& tile);

    FeltSurfaces& surfaces_;
    const SurfaceRecording how_;
    Statement insert_grid_, insert_surface_, insert_place_, insert_tile_, insert_bump_,
        insert_preview_;
    TilePacker packer_{};
    std::int64_t grids_{0}, tiles_{0};  ///< so many rows
    std::set<std::int64_t> bumps_{};    ///< whose map is written
    std::vector<SharedGrid> grids_of_pair_{}, grids_before_{};
    std::vector<Part> parts_{};  ///< of the pair; none: its images are not known
    std::shared_ptr<const MotionField> motion_{};
    std::array<SharedGrid, 2> ways_{};  ///< to the right, down
    std::optional<Vec3> proxy_{};       ///< after the last tick
    /// Contents that were stored, by their bytes; the older half is given up when the newer is
    /// full.
    std::unordered_map<std::string, std::int64_t> known_{}, known_before_{};
    std::size_t known_bytes_{0};
    std::uint64_t missing_{0};
};

}  // namespace dibhr
