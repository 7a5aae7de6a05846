// Notes tiles tick by tick, and writes each of them once.
#include "core/session/surface_writer.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace dibhr {

namespace {

/// Of contents by which a video that repeats is stored once.
constexpr std::size_t kMostKnown_bytes = std::size_t{8} << 20;

}  // namespace

void SurfaceWriter::Grid::want(const TileGrid::Range& range) {
    tiles.visit(range, [this](std::size_t place) {
        if (states[place] != State::absent) return;
        states[place] = State::wanted;
        pending = true;
    });
}

SurfaceWriter::SurfaceWriter(const Database& database, FeltSurfaces& surfaces, SurfaceRecording how)
    : surfaces_(surfaces),
      how_(how),
      insert_grid_(database, "INSERT INTO grid VALUES (?, ?, ?)"),
      insert_surface_(database, "INSERT INTO surface VALUES (?, ?, ?, ?, ?, ?, ?)"),
      insert_place_(database, "INSERT INTO grid_tile VALUES (?, ?, ?)"),
      insert_tile_(database, "INSERT INTO tile VALUES (?, ?)"),
      insert_bump_(database, "INSERT OR IGNORE INTO bump_map VALUES (?, ?)"),
      insert_preview_(database, "INSERT INTO preview VALUES (?, ?)") {}

void SurfaceWriter::begin(std::int64_t pair, const TickRecord& tick) {
    flush();
    grids_before_ = std::exchange(grids_of_pair_, {});
    parts_.clear();
    ways_ = {};
    motion_.reset();
    const std::optional<FeltSurface> felt = surfaces_.surface_of(tick);
    if (!felt || felt->images.empty()) {
        ++missing_;
        return;
    }
    for (const FeltImage& image : felt->images) parts_.push_back(part_of(image));
    take_motion(felt->motion);
    const auto id = [](const SharedGrid& grid) {
        return grid ? std::optional(grid->id) : std::nullopt;
    };
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const bool first = k == 0;  // which has the motion
        insert_surface_.run(pair, k, felt->images[k].levels->highest_level, parts_[k].levels->id,
                            id(parts_[k].unseen), first ? id(ways_[0]) : std::nullopt,
                            first ? id(ways_[1]) : std::nullopt);
    }
    const std::string jpeg = surfaces_.preview();
    if (!jpeg.empty()) insert_preview_.run(pair, SqlBytes{jpeg});
}

void SurfaceWriter::add(const TickRecord& tick, const SessionParameters* parameters,
                        const BumpMap* bump) {
    std::vector<SurfaceRead> others;
    if (parameters != nullptr && how_ == SurfaceRecording::tiles &&
        !(tick.surface && parts_.empty()))
        others = surfaces_.read_by_others(tick, *parameters, bump);
    if (!tick.surface) return;
    const Vec3 before = proxy_.value_or(tick.proxy);
    proxy_ = tick.proxy;
    if (parts_.empty()) return;
    want({read_box(before, tick.proxy, tick.goal, tick.moves), {}}, tick.blend);
    for (const SurfaceRead& read : others) want(read, tick.blend);
}

void SurfaceWriter::want(const SurfaceRead& read, double blend) {
    const TileGrid& tiles = parts_.front().levels->tiles;
    const auto range = [&](const PlaceBox& box) {
        return how_ == SurfaceRecording::whole ? tiles.all()
                                               : tiles.tiles_of(box.wider(kMargin_px));
    };
    const BlendedImages two = blended_images(parts_.size(), blend);
    for (const std::size_t k : {two.from, two.to}) {
        parts_[k].levels->want(range(read.levels));
        if (parts_[k].unseen) parts_[k].unseen->want(range(read.levels));
    }
    if (!motion_) return;
    for (const SharedGrid& grid : ways_) grid->want(range(read.motion));
}

void SurfaceWriter::flush() {
    for (const SharedGrid& grid : grids_of_pair_)
        if (grid->pending) write_tiles(*grid);
}

void SurfaceWriter::add_bump(std::int64_t media, const std::shared_ptr<const BumpMap>& bump) {
    if (!bumps_.insert(media).second) return;
    const SharedGrid grid =
        grid_of(bump, bump->columns, bump->rows,
                [heights = bump->heights.data()](std::size_t k) { return heights[k]; });
    grid->want(grid->tiles.all());
    write_tiles(*grid);
    insert_bump_.run(media, grid->id);
}

template <typename Data, typename Value>
SurfaceWriter::SharedGrid SurfaceWriter::grid_of(const std::shared_ptr<const Data>& data,
                                                 int columns, int rows, Value value) {
    const auto is_it = [&data](const SharedGrid& grid) { return grid->data == data; };
    for (const auto* const grids : {&grids_of_pair_, &grids_before_}) {
        const auto known = std::ranges::find_if(*grids, is_it);
        if (known == grids->end()) continue;
        SharedGrid grid = *known;  // adding to the list may move it
        return grids_of_pair_.emplace_back(std::move(grid));
    }
    auto grid = std::make_shared<Grid>();
    grid->data = data;
    grid->read = [value = std::move(value)](std::size_t first, std::span<float> pixels) {
        for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = value(first + k);
    };
    grid->id = ++grids_;
    grid->columns = columns;
    grid->rows = rows;
    grid->tiles = TileGrid(columns, rows);
    grid->states.resize(grid->tiles.count());
    insert_grid_.run(grid->id, columns, rows);
    return grids_of_pair_.emplace_back(std::move(grid));
}

SurfaceWriter::Part SurfaceWriter::part_of(const FeltImage& image) {
    const DepthImage& levels = *image.levels;
    Part part;
    part.levels = grid_of(image.levels, levels.columns, levels.rows,
                          [data = levels.levels.data()](std::size_t k) { return data[k]; });
    if (image.unseen)
        part.unseen = grid_of(
            image.unseen, levels.columns, levels.rows,
            [data = image.unseen->data()](std::size_t k) { return static_cast<float>(data[k]); });
    return part;
}

void SurfaceWriter::take_motion(const std::shared_ptr<const MotionField>& motion) {
    if (!motion || motion->empty()) return;
    motion_ = motion;
    const MotionField::Way* const ways = motion->ways.data();
    // Two images of one field: each is known by its first number.
    const std::shared_ptr<const float> right(motion, &ways->right);
    const std::shared_ptr<const float> down(motion, &ways->down);
    ways_ = {grid_of(right, motion->columns, motion->rows,
                     [ways](std::size_t k) { return ways[k].right; }),
             grid_of(down, motion->columns, motion->rows,
                     [ways](std::size_t k) { return ways[k].down; })};
}

/// Beyond the image a tile repeats the image's last column and row.
void SurfaceWriter::write_tiles(Grid& grid) {
    grid.pending = false;
    grid.tiles.visit(grid.tiles.all(), [&](std::size_t place) {
        if (grid.states[place] != Grid::State::wanted) return;
        grid.states[place] = Grid::State::written;
        const int left = static_cast<int>(place) % grid.tiles.across() * kTileSide;
        const int top = static_cast<int>(place) / grid.tiles.across() * kTileSide;
        const auto inside = static_cast<std::size_t>(std::min(kTileSide, grid.columns - left));
        Tile tile;
        for (int down = 0; down < kTileSide; ++down) {
            const auto j = static_cast<std::size_t>(std::min(top + down, grid.rows - 1));
            const std::span<float> row(&tile[static_cast<std::size_t>(down * kTileSide)],
                                       static_cast<std::size_t>(kTileSide));
            grid.read(j * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(left),
                      row.first(inside));
            std::ranges::fill(row.subspan(inside), row[inside - 1]);
        }
        insert_place_.run(grid.id, place, tile_id(tile));
    });
}

/// The row of that content, old or new.
std::int64_t SurfaceWriter::tile_id(const Tile& tile) {
    const auto bytes = packer_.pack(tile);
    const std::string content(bytes.begin(), bytes.end());
    for (const auto* contents : {&known_, &known_before_}) {
        const auto found = contents->find(content);
        if (found != contents->end()) return found->second;
    }
    if (known_bytes_ > kMostKnown_bytes) {
        known_before_ = std::exchange(known_, {});
        known_bytes_ = 0;
    }
    known_bytes_ += content.size();
    known_.emplace(content, ++tiles_);
    insert_tile_.run(tiles_, SqlBytes{content});
    return tiles_;
}

}  // namespace dibhr
