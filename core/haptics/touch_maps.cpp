// Maps sampled between their pixels, and heights laid over the VERTEXes.
#include "core/haptics/touch_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/haptics/enum_names.hpp"

namespace dibhr {

namespace {

struct MapFacts {
    TouchMapKind value;
    const char* name;
    const char* unit;
    MapLimits limits;
};

constexpr std::array kMaps{MapFacts{TouchMapKind::stiffness, "stiffness", "N/mm", {0.0, 2.0}},
                           MapFacts{TouchMapKind::friction, "friction", "", {0.0, 2.0}},
                           MapFacts{TouchMapKind::height, "height", "px", {-32.0, 32.0}}};
static_assert(has_all_in_order(kMaps, TouchMapKind::height));

constexpr std::array kKinds{TouchMapKind::stiffness, TouchMapKind::friction, TouchMapKind::height};
static_assert(kKinds.size() == kMaps.size());

/// The two pixels around a place along one axis, and the share of the second.
struct PixelPair {
    int first{0};
    int second{0};
    double share{0.0};
};

/// The pixels around `place_px`, where a map of `pixels` lies over `count` VERTEXes. The centres of
/// both have the same normalised coordinates; exact where both have the same number.
PixelPair pixels_around(double place_px, int count, int pixels) noexcept {
    const double at = pixels == count ? place_px : (place_px + 0.5) / count * pixels - 0.5;
    const double held = std::clamp(at, 0.0, pixels - 1.0);
    const int below = static_cast<int>(held);
    return {below, std::min(below + 1, pixels - 1), held - below};
}

double covering_value(const TouchMap& map, const TouchMap::Pixel& pixel,
                      double otherwise) noexcept {
    const double cover = pixel.cover / TouchMap::kWhole;
    return cover * map.value_of(pixel) + (1.0 - cover) * otherwise;
}

}  // namespace

const char* name_of(TouchMapKind kind) noexcept {
    return entry_of(kMaps, kind).name;
}

std::optional<TouchMapKind> touch_map_kind_named(std::string_view name) noexcept {
    return value_named(kMaps, name);
}

std::span<const TouchMapKind> all_touch_map_kinds() noexcept {
    return kKinds;
}

const char* unit_of(TouchMapKind kind) noexcept {
    return entry_of(kMaps, kind).unit;
}

MapLimits standard_limits(TouchMapKind kind) noexcept {
    return entry_of(kMaps, kind).limits;
}

std::uint16_t TouchMap::level_of(double value) const noexcept {
    const double share = (value - limits.lowest) / (limits.highest - limits.lowest);
    if (!(share > 0.0)) return 0;
    return static_cast<std::uint16_t>(std::lround(std::min(share, 1.0) * kWhole));
}

bool TouchMap::covers_anything() const noexcept {
    return std::any_of(pixels.begin(), pixels.end(),
                       [](const Pixel& pixel) { return pixel.cover > 0; });
}

TouchMap bare_map(TouchMapKind kind, int columns, int rows) {
    const std::size_t count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    return {columns, rows, standard_limits(kind), std::vector<TouchMap::Pixel>(count)};
}

double map_value(const TouchMap& map, double x, double y, int columns, int rows,
                 double otherwise) noexcept {
    const PixelPair across = pixels_around(x, columns, map.columns);
    const PixelPair down = pixels_around(y, rows, map.rows);
    const auto at = [&](int i, int j) { return covering_value(map, map.at(i, j), otherwise); };
    const auto along = [&](int j) {
        return (1.0 - across.share) * at(across.first, j) + across.share * at(across.second, j);
    };
    return (1.0 - down.share) * along(down.first) + down.share * along(down.second);
}

TouchMap& TouchMaps::of(TouchMapKind kind) noexcept {
    if (kind == TouchMapKind::stiffness) return stiffness;
    return kind == TouchMapKind::friction ? friction : height;
}

const TouchMap& TouchMaps::of(TouchMapKind kind) const noexcept {
    if (kind == TouchMapKind::stiffness) return stiffness;
    return kind == TouchMapKind::friction ? friction : height;
}

void lay_heights(TouchMaps& maps, int columns, int rows) {
    maps.at_vertices = {};
    if (maps.height.empty()) return;
    TouchMaps::AtVertices laid{columns, rows, 0.0, {}};
    laid.heights_px.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const bool same_size = maps.height.columns == columns && maps.height.rows == rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double felt = same_size ? covering_value(maps.height, maps.height.at(i, j), 0.0)
                                          : map_value(maps.height, i, j, columns, rows, 0.0);
            const auto height = static_cast<float>(felt);
            laid.heights_px.push_back(height);
            laid.highest_px = std::max(laid.highest_px, static_cast<double>(height));
        }
    }
    maps.at_vertices = std::move(laid);
}

}  // namespace dibhr
