// Lays stored tiles into images.
#include "core/session/surface_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

namespace {

// Two frames, the most in-betweens of any recording, and as many of the pair before.
constexpr double kLeastHighest = 1e-6;  ///< of an image: what is below is no highest level
constexpr std::size_t kMostKept = 20;
constexpr std::size_t kMostKeptPixels = std::size_t{1} << 27;
constexpr std::size_t kMostPixelsOfSurface = 320'000'000;  // nine parts of 8K
constexpr std::int64_t kLongestSide = 1 << 15;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;

}  // namespace

bool StoredSurface::holds(const SurfaceRead& read, double blend) const noexcept {
    const BlendedImages two = blended_images(stored.size(), blend);
    bool all = true;
    tiles.visit(tiles.tiles_of(read.levels), [&](std::size_t place) {
        all = all && (*stored[two.from])[place] != 0 && (*stored[two.to])[place] != 0;
    });
    if (stored_motion.empty()) return all;
    tiles.visit(tiles.tiles_of(read.motion),
                [&](std::size_t place) { all = all && stored_motion[place] != 0; });
    return all;
}

SurfaceReader::SurfaceReader(const SessionReader& session) : session_(session) {
    Statement tables = session_.rows(
        "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name IN "
        "('grid', 'surface', 'grid_tile', 'tile', 'bump_map')");
    if (!tables.next() || tables.integer(0) != 5) return;  // of before they were stored
    any_ = session_.rows("SELECT 1 FROM surface LIMIT 1").next();
}

std::optional<StoredSurface> SurfaceReader::surface(std::int64_t pair) {
    if (!any_) return std::nullopt;
    StoredSurface surface;
    Statement parts =
        session_.rows("SELECT highest, levels, unseen, right, down FROM surface WHERE pair = " +
                      std::to_string(pair) + " ORDER BY part");
    while (parts.next()) {
        Levels read = levels(parts.integer(1), parts.real(0));
        FeltImage image{.levels = std::move(read.image)};
        if (parts.has(2)) image.unseen = marks(parts.integer(2));
        if (parts.has(3) && parts.has(4)) read_motion(parts.integer(3), parts.integer(4), surface);
        surface.felt.images.push_back(std::move(image));
        surface.stored.push_back(std::move(read.stored));
        const DepthImage& first = *surface.felt.images.front().levels;
        const FeltImage& last = surface.felt.images.back();
        const bool fits =
            first.highest_level >= kLeastHighest && std::isfinite(first.highest_level) &&
            last.levels->columns == first.columns && last.levels->rows == first.rows &&
            last.levels->highest_level == first.highest_level &&
            (!last.unseen || last.unseen->size() == first.levels.size());
        if (!fits || surface.felt.images.size() * first.levels.size() > kMostPixelsOfSurface)
            refuse("pair " + std::to_string(pair) + " has images that make no surface");
    }
    if (surface.felt.images.empty()) return std::nullopt;
    const DepthImage& first = *surface.felt.images.front().levels;
    const MotionField* const motion = surface.felt.motion.get();
    if (motion != nullptr && (motion->columns != first.columns || motion->rows != first.rows))
        refuse("pair " + std::to_string(pair) + " has a motion of another size");
    surface.tiles = TileGrid(first.columns, first.rows);
    return surface;
}

std::shared_ptr<const BumpMap> SurfaceReader::bump(const std::filesystem::path& file) {
    if (!any_) return nullptr;
    Statement rows =
        session_.rows("SELECT m.file, b.grid FROM bump_map b JOIN media m ON m.id = b.media");
    while (rows.next()) {
        if (rows.text(0) != file) continue;
        Grid read = grid(rows.integer(1));
        const auto is_height = [](float height) { return height >= 0.0F && height <= 1.0F; };
        if (!std::ranges::all_of(read.values, is_height)) refuse("a bump map has other heights");
        return std::make_shared<BumpMap>(BumpMap{read.columns, read.rows, std::move(read.values)});
    }
    return nullptr;
}

bool SurfaceReader::has_previews() const {
    return session_.rows("SELECT 1 FROM sqlite_master WHERE name = 'preview' AND rootpage > 0")
        .next();
}

SurfaceReader::PreviewExtent SurfaceReader::preview_extent() const {
    if (!has_previews()) return {};
    Statement row = session_.rows("SELECT count(*), ifnull(sum(length(jpeg)), 0) FROM preview");
    return row.next() ? PreviewExtent{row.integer(0), row.integer(1)} : PreviewExtent{};
}

void SurfaceReader::read_previews() {
    constexpr std::size_t kMostPreviews = 1'000'000;  // more than a week
    previews_.emplace();
    if (!has_previews()) return;
    Statement rows = session_.rows(
        "SELECT s.media, q.from_s, v.pair FROM preview v JOIN pair q ON q.id = v.pair "
        "JOIN source s ON s.id = q.source");
    while (rows.next() && previews_->size() < kMostPreviews)
        previews_->push_back(
            {static_cast<std::uint32_t>(rows.integer(0)), rows.real(1), rows.integer(2)});
}

const std::string& SurfaceReader::preview(std::uint32_t media, double media_s) {
    if (!previews_) read_previews();
    const Preview* nearest = nullptr;
    for (const Preview& one : *previews_) {
        const auto off = [media_s](const Preview& other) {
            return std::abs(other.media_s - media_s);
        };
        if (one.media == media && (nearest == nullptr || off(one) < off(*nearest))) nearest = &one;
    }
    const std::int64_t pair = nearest == nullptr ? 0 : nearest->pair;
    if (pair == std::exchange(preview_pair_, pair)) return preview_;
    preview_.clear();
    if (nearest == nullptr) return preview_;
    Statement row = session_.rows("SELECT jpeg FROM preview WHERE pair = " + std::to_string(pair));
    if (row.next()) preview_ = row.bytes(0);
    return preview_;
}

template <typename Thing, typename Read>
Thing SurfaceReader::kept(Kept<Thing>& all, std::int64_t id, Read&& read) {
    const auto found = std::ranges::find_if(all, [id](const auto& one) { return one.first == id; });
    if (found != all.end()) return found->second;
    Thing thing = read();
    const std::size_t most = std::clamp<std::size_t>(
        kMostKeptPixels / std::max<std::size_t>(thing.size(), 1), 2, kMostKept);
    while (all.size() >= most) all.pop_front();
    return all.emplace_back(id, std::move(thing)).second;
}

SurfaceReader::Levels SurfaceReader::levels(std::int64_t id, double highest) {
    return kept(levels_, id, [&] {
        Grid read = grid(id);
        const auto is_level = [](float level) { return std::isfinite(level); };
        if (!std::ranges::all_of(read.values, is_level)) refuse("a level is not a number");
        return Levels{std::make_shared<DepthImage>(
                          DepthImage{read.columns, read.rows, highest, std::move(read.values)}),
                      std::make_shared<std::vector<std::uint8_t>>(std::move(read.stored))};
    });
}

std::shared_ptr<const std::vector<std::uint8_t>> SurfaceReader::marks(std::int64_t id) {
    const auto read = [this, id] {
        const Grid all = grid(id);
        auto marks = std::make_shared<std::vector<std::uint8_t>>(all.values.size());
        std::ranges::transform(all.values, marks->begin(), [](float value) {
            return static_cast<std::uint8_t>(value != 0.0F ? 1 : 0);
        });
        return Marks{std::move(marks)};
    };
    return kept(marks_, id, read).marks;
}

void SurfaceReader::read_motion(std::int64_t right, std::int64_t down, StoredSurface& surface) {
    Grid across = grid(right);
    const Grid along = grid(down);
    if (across.values.size() != along.values.size() || across.columns != along.columns)
        refuse("a motion has parts of two sizes");
    auto field = std::make_shared<MotionField>();
    field->columns = across.columns;
    field->rows = across.rows;
    field->ways.reserve(across.values.size());
    for (std::size_t k = 0; k < across.values.size(); ++k)
        field->ways.push_back({across.values[k], along.values[k]});
    surface.felt.motion = std::move(field);
    surface.stored_motion = std::move(across.stored);
}

SurfaceReader::Grid SurfaceReader::grid(std::int64_t id) {
    const std::string number = std::to_string(id);
    Statement size = session_.rows("SELECT columns, rows FROM grid WHERE id = " + number);
    if (!size.next()) refuse("it lacks the size of grid " + number);
    const std::int64_t columns = size.integer(0);
    const std::int64_t rows = size.integer(1);
    if (columns < 1 || rows < 1 || columns > kLongestSide || rows > kLongestSide ||
        columns * rows > kMostPixels)
        refuse("grid " + number + " has a size that no surface has");
    Grid grid{static_cast<int>(columns), static_cast<int>(rows), {}, {}};
    grid.values.resize(static_cast<std::size_t>(columns * rows));
    grid.stored.resize(TileGrid(grid.columns, grid.rows).count());
    Statement tiles = session_.rows(
        "SELECT p.place, t.code FROM grid_tile p LEFT JOIN tile t ON t.id = p.tile "
        "WHERE p.grid = " +
        number);
    while (tiles.next()) {
        const std::int64_t place = tiles.integer(0);
        if (place < 0 || place >= std::ssize(grid.stored))
            refuse("grid " + number + " has a tile beyond its end");
        lay(tiles.bytes(1), static_cast<std::size_t>(place), grid);
    }
    return grid;
}

void SurfaceReader::lay(const std::string& bytes, std::size_t place, Grid& grid) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const std::optional<Tile> tile = unpacker_.unpack({first, bytes.size()});
    if (!tile) refuse("a tile of its surface cannot be unpacked");
    grid.stored[place] = 1;
    const int across = TileGrid(grid.columns, grid.rows).across();
    const int left = static_cast<int>(place) % across * kTileSide;
    const int top = static_cast<int>(place) / across * kTileSide;
    const int right = std::min(left + kTileSide, grid.columns);
    const int bottom = std::min(top + kTileSide, grid.rows);
    for (int j = top; j < bottom; ++j) {
        const auto row = tile->begin() + std::ptrdiff_t{j - top} * kTileSide;
        std::copy(row, row + (right - left),
                  grid.values.begin() + std::ptrdiff_t{j} * grid.columns + left);
    }
}

void SurfaceReader::refuse(const std::string& what) const {
    throw InputError(session_.file().string() + ": is damaged (" + what + "); copy it again");
}

}  // namespace dibhr
