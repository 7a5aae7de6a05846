// Maps of stiffness, friction and height over a depth image: per pixel they replace, or are added
// to, the values that the panel sets for the whole image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/haptics/parameters.hpp"

namespace dibhr {

/// The values of the lowest and the highest level of a map, in its unit; linear in between.
struct MapLimits {
    double lowest{0.0};
    double highest{1.0};

    bool operator==(const MapLimits&) const = default;
};

/// What a map is of.
enum class TouchMapKind { stiffness, friction, height };

/// "stiffness", "friction" or "height": the name of its file and its column. The first two are
/// those of the textures in glTF's MPEG_haptic_material.
[[nodiscard]] const char* name_of(TouchMapKind kind) noexcept;
/// The kind of that name, or nothing.
[[nodiscard]] std::optional<TouchMapKind> touch_map_kind_named(std::string_view name) noexcept;
/// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const TouchMapKind> all_touch_map_kinds() noexcept;
/// "N/mm", "" or "px".
[[nodiscard]] const char* unit_of(TouchMapKind kind) noexcept;
/// Stiffness 0 to 2 N/mm, friction 0 to 2, height -32 to 32 px.
[[nodiscard]] MapLimits standard_limits(TouchMapKind kind) noexcept;

/// One number a pixel, of its own resolution, stretched over the depth image: columns x rows,
/// row-major. Without pixels there is no map.
struct TouchMap {
    /// `cover`: the map's weight at the pixel, kWhole for all, 0 for none.
    struct Pixel {
        std::uint16_t level{0};  ///< 0: the lowest, kWhole: the highest of `limits`
        std::uint16_t cover{0};

        bool operator==(const Pixel&) const = default;
    };
    static constexpr double kWhole = 65535.0;

    int columns{0};
    int rows{0};
    MapLimits limits{};
    std::vector<Pixel> pixels{};

    [[nodiscard]] bool empty() const noexcept { return pixels.empty(); }
    [[nodiscard]] Pixel& at(int i, int j) { return pixels[index(i, j)]; }
    [[nodiscard]] const Pixel& at(int i, int j) const { return pixels[index(i, j)]; }
    [[nodiscard]] double value_of(const Pixel& pixel) const noexcept {
        return limits.lowest + (limits.highest - limits.lowest) * (pixel.level / kWhole);
    }
    /// The level that is nearest to a value, held in the limits.
    [[nodiscard]] std::uint16_t level_of(double value) const noexcept;
    /// Whether any pixel has a cover above 0.
    [[nodiscard]] bool covers_anything() const noexcept;

    bool operator==(const TouchMap&) const = default;

  private:
    [[nodiscard]] std::size_t index(int i, int j) const noexcept {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(i);
    }
};

/// A map whose cover is 0 everywhere.
[[nodiscard]] TouchMap bare_map(TouchMapKind kind, int columns, int rows);

/// Bilinear, at (x, y) of a depth image of columns x rows [px], held at its border: the map's value
/// where it covers, `otherwise` where it does not, and between them in proportion. Of a map as
/// large as the image its pixels are the VERTEXes.
[[nodiscard]] double map_value(const TouchMap& map, double x, double y, int columns, int rows,
                               double otherwise) noexcept;

/// The maps of a recording. Immutable once frames carry them.
struct TouchMaps {
    TouchMap stiffness{};  ///< [N/mm] instead of Coupling::stiffness_newton_per_mm
    TouchMap friction{};  ///< instead of Friction::static_coefficient; the dynamic one in its ratio
    TouchMap height{};    ///< [px] on top of the elevation
    /// Of the height map at every VERTEX of a depth image of one size; see lay_heights().
    struct AtVertices {
        int columns{0};
        int rows{0};
        double highest_px{0.0};  ///< no height is greater; 0 or more
        std::vector<float> heights_px{};
    };
    AtVertices at_vertices{};
    /// Number of these maps among all that the program made; 0: none.
    std::uint32_t version{0};

    [[nodiscard]] TouchMap& of(TouchMapKind kind) noexcept;
    [[nodiscard]] const TouchMap& of(TouchMapKind kind) const noexcept;
    [[nodiscard]] bool empty() const noexcept {
        return stiffness.empty() && friction.empty() && height.empty();
    }
};

/// Computes the height map at the VERTEXes of depth images of columns x rows; over other sizes it
/// has no effect. To be called again when the map changes.
void lay_heights(TouchMaps& maps, int columns, int rows);

}  // namespace dibhr
