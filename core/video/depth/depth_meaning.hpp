// What the levels of a depth source mean: statements of several origins, the meaning merged from
// them, and how high a level stands. The requested cleaning is stated in the same places.
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

/// What a level times its scale is: `levels` are linear in elevation without a unit, `disparity` is
/// one over a distance without a unit, `mm` and `m` are distances from the camera.
enum class DepthUnit { levels, disparity, mm, m };

/// Where colour and depth are: in files of their own, in halves of one picture (colour first), or
/// in tracks of one file.
enum class DepthPacking { separate, left_right, right_left, top_bottom, bottom_top, tracks };

/// How a picture holds depth: by its brightness, by its hue, as a number in the bytes of its
/// channels (byte_code.hpp), or in levels that are no distances (level_code.hpp).
enum class DepthCode {
    grey,
    hue,
    rg16,
    rgb24,
    float32,
    terrain,
    turned16,
    kinect11,
    stereo,
    xyz,
    depth16,
    gb16,
    bgr24,
    float32_bgra
};

/// `relief`: the picture plane plus elevation, as in the paper. `true_shape`: the shape in
/// millimetres, in orthographic view.
enum class Geometry { relief, true_shape };

/// When pictures without presentation times are shown. `counted`: 1/30 s apart, in the order of
/// their numbers. `own`: by the stamps in their names or in a file beside them, else counted.
/// `paired`: colour or depth takes the times of the other's frames.
enum class DepthTimes { counted, own, paired };

[[nodiscard]] std::string_view name_of(NearLevels value) noexcept;
[[nodiscard]] std::string_view name_of(DepthUnit value) noexcept;
[[nodiscard]] std::string_view name_of(DepthPacking value) noexcept;
[[nodiscard]] std::string_view name_of(DepthCode value) noexcept;
[[nodiscard]] std::string_view name_of(Geometry value) noexcept;
[[nodiscard]] std::string_view name_of(DepthTimes value) noexcept;

/// Whether its values are distances from the camera.
[[nodiscard]] constexpr bool is_distance(DepthUnit unit) noexcept {
    return unit == DepthUnit::mm || unit == DepthUnit::m;
}
/// A value of 1 in that unit of distances, in millimetres.
[[nodiscard]] constexpr double one_in_mm(DepthUnit unit) noexcept {
    return unit == DepthUnit::m ? 1000.0 : 1.0;
}

inline constexpr std::array kNearLevels{NearLevels::bright, NearLevels::dark};
inline constexpr std::array kDepthUnits{DepthUnit::levels, DepthUnit::disparity, DepthUnit::mm,
                                        DepthUnit::m};
inline constexpr std::array kDepthPackings{DepthPacking::separate,   DepthPacking::left_right,
                                           DepthPacking::right_left, DepthPacking::top_bottom,
                                           DepthPacking::bottom_top, DepthPacking::tracks};
inline constexpr std::array kDepthCodes{
    DepthCode::grey,    DepthCode::hue,         DepthCode::rg16,     DepthCode::rgb24,
    DepthCode::float32, DepthCode::terrain,     DepthCode::turned16, DepthCode::kinect11,
    DepthCode::stereo,  DepthCode::xyz,         DepthCode::depth16,  DepthCode::gb16,
    DepthCode::bgr24,   DepthCode::float32_bgra};
inline constexpr std::array kGeometries{Geometry::relief, Geometry::true_shape};
inline constexpr std::array kDepthTimes{DepthTimes::counted, DepthTimes::own, DepthTimes::paired};

/// The nearest and the farthest value that are not clamped, in the unit (level times scale).
struct DepthRange {
    double near{0.0};
    double far{0.0};

    bool operator==(const DepthRange&) const = default;
};

/// A pinhole camera in depth pixels: focal lengths, and where its axis meets the picture (0, 0: the
/// centre of the first pixel).
struct Intrinsics {
    double fx{0.0}, fy{0.0}, cx{0.0}, cy{0.0};
    /// Horizontal field of view, given instead of the others while the picture's size is not known
    /// [degrees]; 0: the others are given.
    double field_of_view_deg{0.0};

    bool operator==(const Intrinsics&) const = default;
};

/// Where the colour picture lies over the depth picture: moved by depth pixels to the right and
/// down, and scaled about its middle.
struct Registration {
    double right_px{0.0}, down_px{0.0};
    double scale{1.0};

    bool operator==(const Registration&) const = default;
};

/// Whether a camera can have these: finite numbers, and focal lengths of a thousandth of a pixel or
/// more.
[[nodiscard]] bool is_camera(const Intrinsics& intrinsics);

/// The same in pixels for a picture of that size: a field of view becomes focal lengths of square
/// pixels, with the axis through the middle.
[[nodiscard]] Intrinsics in_pixels(const Intrinsics& stated, int columns, int rows);

/// Facts of a depth source from one origin: the file's metadata, a sidecar, the panel, the command
/// line. Facts that it does not state are empty.
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
    std::optional<DepthTimes> times{};
    std::optional<double> time_offset_s{};  ///< how much later the depth is than its times say
    std::optional<double> frames_per_s{};   ///< of the depth; 0: as its source has it

    bool operator==(const DepthStatement&) const = default;
    /// Takes from `other` the facts that this does not state.
    void fill_in(const DepthStatement& other);
};

/// Where a fact of the meaning comes from; later ones have priority over those before. `folder`: an
/// answer of a person for all files of the folder, where the file leaves that fact open.
enum class Origin { assumed, found, folder, sidecar, panel, command_line, recorded };

/// "assumed", "found", "folder", "sidecar", "panel", "command line", "recorded".
[[nodiscard]] std::string_view name_of(Origin value) noexcept;

/// A fact and its origin.
template <typename Value>
struct Known {
    Value value{};
    Origin origin{Origin::assumed};

    bool operator==(const Known&) const = default;
};

/// The complete meaning of the levels of a source.
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
    Known<Registration> registration{};             ///< in addition to the file's calibration
    Known<CleaningChoice> cleaning{};               ///< automatic: not stated
    Known<double> finger_mm{0.0};                   ///< 0: a point
    Known<DepthTimes> times{DepthTimes::counted};
    Known<double> time_offset_s{0.0};
    Known<double> frames_per_s{0.0};  ///< 0: not stated
    std::string found_in{};           ///< where `found` facts are from: "TUM lists"; empty: none

    [[nodiscard]] bool is_metric() const { return is_distance(unit.value); }
    /// All facts as one statement, for a recording or a sidecar.
    [[nodiscard]] DepthStatement statement() const;
};

/// Visits each fact of a statement and a meaning, or of two statements: visit(name, fact of one,
/// fact of other).
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
    visit("times", one.times, other.times);
    visit("time_offset_s", one.time_offset_s, other.time_offset_s);
    visit("stated_frames_per_s", one.frames_per_s, other.frames_per_s);
}

/// Statements with their origins, the one of highest priority first.
using RankedStatements = std::vector<std::pair<Origin, DepthStatement>>;

/// Sets each fact to that of the first statement that has it; facts without a statement stay.
void merge_by_priority(const RankedStatements& statements, DepthMeaning& meaning);

/// The value in which elevation is linear: the value itself, or one over it for disparity.
[[nodiscard]] double linear_value(DepthUnit unit, double value);

/// The value in the unit at an elevation; `nearness` in [0, 1]: from the farthest to the nearest.
[[nodiscard]] double value_at(const DepthMeaning& meaning, double nearness);
/// Its inverse: not clamped, from 0 at the farthest value to 1 at the nearest.
[[nodiscard]] double nearness_at(const DepthMeaning& meaning, double value);

/// What a person states who turns near and far: the same values as levels of the same scale, with
/// the other end of the range near. That mirrors the relief of levels and distances. One of
/// disparities becomes that of distances without a unit, which is what they are if they are near
/// where dark.
[[nodiscard]] DepthStatement turned_near_and_far(const DepthMeaning& meaning);

/// One line for people: "distance 480 to 4210 mm, near is dark, no data is 0 and 65535".
[[nodiscard]] std::string in_words(const DepthMeaning& meaning);

/// The names of the assumed facts, as `info` lists them: "near", "unit", "scale", "range", ...
[[nodiscard]] std::vector<std::string> assumed_facts(const DepthMeaning& meaning);

}  // namespace dibhr
