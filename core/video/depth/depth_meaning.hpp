// What the levels of a depth source mean: what somebody says of them, what is known in the end and
// from whom, and how high a level stands. How they are to be cleaned is said in the same places.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/video/frames/cleaning_options.hpp"

namespace dibhr {

/// Which levels are near to the camera.
enum class NearLevels { bright, dark };

/// What a level times its scale is: of no unit and linear, of no unit and one over a distance, or a
/// distance from the camera.
enum class DepthUnit { levels, disparity, mm, m };

/// Where colour and depth are: in files of their own, in halves of one picture (colour first), or
/// in tracks of one file.
enum class DepthPacking { separate, left_right, right_left, top_bottom, bottom_top, tracks };

/// How a picture holds depth: by its brightness, or by its hue.
enum class DepthCode { grey, hue };

/// The picture plane plus elevation, as in the paper, or the shape in millimetres, seen straight
/// on.
enum class Geometry { relief, true_shape };

[[nodiscard]] std::string_view name_of(NearLevels value) noexcept;
[[nodiscard]] std::string_view name_of(DepthUnit value) noexcept;
[[nodiscard]] std::string_view name_of(DepthPacking value) noexcept;
[[nodiscard]] std::string_view name_of(DepthCode value) noexcept;
[[nodiscard]] std::string_view name_of(Geometry value) noexcept;

inline constexpr std::array kNearLevels{NearLevels::bright, NearLevels::dark};
inline constexpr std::array kDepthUnits{DepthUnit::levels, DepthUnit::disparity, DepthUnit::mm,
                                        DepthUnit::m};
inline constexpr std::array kDepthPackings{DepthPacking::separate,   DepthPacking::left_right,
                                           DepthPacking::right_left, DepthPacking::top_bottom,
                                           DepthPacking::bottom_top, DepthPacking::tracks};
inline constexpr std::array kDepthCodes{DepthCode::grey, DepthCode::hue};
inline constexpr std::array kGeometries{Geometry::relief, Geometry::true_shape};

/// Values in the unit (level times scale): the nearest and the farthest that are told apart.
struct DepthRange {
    double near{0.0};
    double far{0.0};

    bool operator==(const DepthRange&) const = default;
};

/// Of a pinhole camera, in depth pixels: the focal lengths, and where its axis meets the picture
/// (0, 0: the centre of the first pixel).
struct Intrinsics {
    double fx{0.0}, fy{0.0}, cx{0.0}, cy{0.0};
    /// Said in place of those while the picture's size is not known: what it shows from its left to
    /// its right edge [degrees]; 0: the others are said.
    double field_of_view_deg{0.0};

    bool operator==(const Intrinsics&) const = default;
};

/// Where the colour picture lies over the depth picture: so many depth pixels to the right and
/// down, and so many times as large, about its middle.
struct Registration {
    double right_px{0.0}, down_px{0.0};
    double scale{1.0};

    bool operator==(const Registration&) const = default;
};

/// Whether it is a camera at all: of finite numbers, and focal lengths of a thousandth of a pixel
/// or more.
[[nodiscard]] bool is_camera(const Intrinsics& intrinsics);

/// The same for a picture of that size: of a field of view, with square pixels and the axis through
/// the middle.
[[nodiscard]] Intrinsics in_pixels(const Intrinsics& said, int columns, int rows);

/// What one voice says of a depth source: a file's own metadata, a sidecar, the panel, the command
/// line. What it does not say is empty.
struct DepthStatement {
    std::optional<NearLevels> near{};
    std::optional<DepthUnit> unit{};
    std::optional<double> scale{};  ///< one level in that unit
    std::optional<DepthRange> range{};
    std::optional<std::vector<double>> no_data{};  ///< levels of the file that mean nothing
    std::optional<DepthPacking> packing{};
    std::optional<DepthCode> code{};
    std::optional<Geometry> geometry{};
    std::optional<Intrinsics> intrinsics{};
    std::optional<Registration> registration{};
    std::optional<CleaningChoice> cleaning{};
    std::optional<double> finger_mm{};  ///< radius of the fingertip

    bool operator==(const DepthStatement&) const = default;
    /// What `other` says, where this says nothing.
    void fill_in(const DepthStatement& other);
};

/// Whose word a fact of the meaning is; a later one beats those before it.
enum class Origin { assumed, found, sidecar, panel, command_line, recorded };

/// "assumed", "found", "sidecar", "panel", "command line", "recorded".
[[nodiscard]] std::string_view name_of(Origin value) noexcept;

/// A fact and whose word it is.
template <typename Value>
struct Known {
    Value value{};
    Origin origin{Origin::assumed};

    bool operator==(const Known&) const = default;
};

/// What the levels of a source mean, all said.
struct DepthMeaning {
    Known<NearLevels> near{NearLevels::bright};
    Known<DepthUnit> unit{DepthUnit::levels};
    Known<double> scale{1.0};
    Known<DepthRange> range{};  ///< near > far for levels that are near where bright, disparity
    Known<std::vector<double>> no_data{};
    Known<DepthPacking> packing{DepthPacking::separate};
    Known<DepthCode> code{DepthCode::grey};
    Known<Geometry> geometry{Geometry::relief};
    Known<std::optional<Intrinsics>> intrinsics{};  ///< nothing: not known
    Known<Registration> registration{};  ///< beyond what the file's calibration says of it
    Known<CleaningChoice> cleaning{};    ///< automatic: nobody says else
    Known<double> finger_mm{0.0};        ///< 0: a point
    std::string found_in{};  ///< where what was found was found: "TUM lists"; empty: nowhere

    [[nodiscard]] bool is_metric() const {
        return unit.value == DepthUnit::mm || unit.value == DepthUnit::m;
    }
    /// All of it, as one voice: a recording's, or a sidecar's.
    [[nodiscard]] DepthStatement statement() const;
};

/// Each fact of depth with its name, out of a statement and a meaning, or out of two statements:
/// visit(name, fact of one, fact of other).
template <typename One, typename Other, typename Visit>
void visit_facts(One& one, Other& other, const Visit& visit) {
    visit("near", one.near, other.near);
    visit("unit", one.unit, other.unit);
    visit("scale", one.scale, other.scale);
    visit("range", one.range, other.range);
    visit("no_data", one.no_data, other.no_data);
    visit("packing", one.packing, other.packing);
    visit("code", one.code, other.code);
    visit("geometry", one.geometry, other.geometry);
    visit("intrinsics", one.intrinsics, other.intrinsics);
    visit("registration", one.registration, other.registration);
    visit("cleaning", one.cleaning, other.cleaning);
    visit("finger_mm", one.finger_mm, other.finger_mm);
}

/// Statements by whose word they are, the strongest first.
using Voices = std::vector<std::pair<Origin, DepthStatement>>;

/// What the strongest voice says of each thing; where none says anything it stays as it is.
void hear(const Voices& voices, DepthMeaning& meaning);

/// The value on the line on which elevation is linear: the value itself, or one over it.
[[nodiscard]] double on_the_line(DepthUnit unit, double value);

/// The value in the unit that stands there, `nearness` in [0, 1] of the way from the farthest to
/// the nearest.
[[nodiscard]] double value_at(const DepthMeaning& meaning, double nearness);

/// In one line, for a person: "distance 480 to 4210 mm, near is dark, no data is 0 and 65535".
[[nodiscard]] std::string in_words(const DepthMeaning& meaning);

/// The names of what was assumed, as `info` lists them: "near", "unit", "scale", "range", ...
[[nodiscard]] std::vector<std::string> assumed_facts(const DepthMeaning& meaning);

}  // namespace dibhr
