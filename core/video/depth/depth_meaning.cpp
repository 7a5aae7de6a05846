// Names of the facts' values, and merging of statements by priority.
#include "core/video/depth/depth_meaning.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

using Name = std::string_view;

constexpr std::array<Name, kDepthUnits.size()> kUnitNames{"levels", "disparity", "mm", "m"};
constexpr std::array<Name, kDepthPackings.size()> kPackingNames{
    "separate", "left-right", "right-left", "top-bottom", "bottom-top", "tracks"};
constexpr std::array<Name, kDepthCodes.size()> kCodeNames{
    "grey",     "hue",    "rg16", "rgb24",   "float32", "terrain", "turned16",
    "kinect11", "stereo", "xyz",  "depth16", "gb16",    "bgr24",   "float32-bgra"};
constexpr std::array<Name, kDepthTimes.size()> kTimesNames{"counted", "own", "paired"};
constexpr std::array<Name, 7> kOriginNames{"assumed", "found",        "folder",  "sidecar",
                                           "panel",   "command line", "recorded"};

}  // namespace

std::string_view name_of(NearLevels value) noexcept {
    return value == NearLevels::bright ? "bright" : "dark";
}

std::string_view name_of(DepthUnit value) noexcept {
    return kUnitNames[static_cast<std::size_t>(value)];
}

std::string_view name_of(DepthPacking value) noexcept {
    return kPackingNames[static_cast<std::size_t>(value)];
}

std::string_view name_of(DepthCode value) noexcept {
    return kCodeNames[static_cast<std::size_t>(value)];
}

std::string_view name_of(Geometry value) noexcept {
    return value == Geometry::relief ? "relief" : "true";
}

std::string_view name_of(DepthTimes value) noexcept {
    return kTimesNames[static_cast<std::size_t>(value)];
}

bool is_camera(const Intrinsics& intrinsics) {
    constexpr double kMost = 1e7;    // pixels; no picture is as large
    constexpr double kLeast = 1e-3;  // below, one pixel sees everything before the camera
    const auto is_length = [](double value) { return value >= kLeast && value < kMost; };
    return is_length(intrinsics.fx) && is_length(intrinsics.fy) &&
           std::abs(intrinsics.cx) < kMost && std::abs(intrinsics.cy) < kMost;
}

Intrinsics in_pixels(const Intrinsics& stated, int columns, int rows) {
    if (!(stated.field_of_view_deg > 0.0)) return stated;
    const double half_view = 0.5 * stated.field_of_view_deg * std::numbers::pi / 180.0;
    const double focal = 0.5 * columns / std::tan(half_view);
    return {focal, focal, 0.5 * (columns - 1), 0.5 * (rows - 1)};
}

void DepthStatement::fill_in(const DepthStatement& other) {
    const auto take = [](const char* /*name*/, auto& mine, const auto& theirs) {
        if (!mine) mine = theirs;
    };
    visit_facts(*this, other, take);
}

std::string_view name_of(Origin value) noexcept {
    return kOriginNames[static_cast<std::size_t>(value)];
}

DepthStatement DepthMeaning::statement() const {
    DepthStatement all;
    visit_facts(all, *this,
                [](const char* /*name*/, auto& stated, const auto& fact) { stated = fact.value; });
    return all;
}

void merge_by_priority(const RankedStatements& statements, DepthMeaning& meaning) {
    for (auto ranked = statements.rbegin(); ranked != statements.rend(); ++ranked) {
        const Origin origin = ranked->first;
        visit_facts(ranked->second, meaning,
                    [origin](const char* /*name*/, const auto& stated, auto& fact) {
                        if (stated) fact = {*stated, origin};
                    });
    }
}

double linear_value(DepthUnit unit, double value) {
    return unit == DepthUnit::disparity ? 1.0 / value : value;
}

double value_at(const DepthMeaning& meaning, double nearness) {
    const DepthUnit unit = meaning.unit.value;
    const double far = linear_value(unit, meaning.range.value.far);
    const double near = linear_value(unit, meaning.range.value.near);
    return linear_value(unit, far + nearness * (near - far));  // its own inverse
}

double nearness_at(const DepthMeaning& meaning, double value) {
    const DepthUnit unit = meaning.unit.value;
    const double far = linear_value(unit, meaning.range.value.far);
    const double near = linear_value(unit, meaning.range.value.near);
    return (linear_value(unit, value) - far) / (near - far);
}

DepthStatement turned_near_and_far(const DepthMeaning& meaning) {
    const DepthRange& range = meaning.range.value;
    DepthStatement other;
    other.near = meaning.near.value == NearLevels::bright ? NearLevels::dark : NearLevels::bright;
    other.unit = DepthUnit::levels;
    other.scale = meaning.scale.value;
    other.range = DepthRange{range.far, range.near};
    if (meaning.geometry.value == Geometry::true_shape) other.geometry = Geometry::relief;
    return other;
}

namespace {

/// An end of a range: "4.21", "480", "10720".
std::string end_text(double value) {
    constexpr double kTooLong = 1e4;  // for four digits: it would be written as 1.072e+04
    return std::abs(value) < kTooLong ? short_text(value, 4) : number_text(value, 0);
}

}  // namespace

std::string in_words(const DepthMeaning& meaning) {
    const DepthRange& range = meaning.range.value;
    const std::string ends = end_text(range.near) + " to " + end_text(range.far);
    const std::string unit(name_of(meaning.unit.value));
    std::string words = meaning.is_metric() ? "distance " + ends + " " + unit : unit + " " + ends;
    words += ", near is " + std::string(name_of(meaning.near.value));
    const std::vector<double>& nothing = meaning.no_data.value;
    for (std::size_t k = 0; k < nothing.size(); ++k) {
        const bool is_last = k + 1 == nothing.size();
        words += k == 0 ? ", no data is " : is_last ? " and " : ", ";
        words += short_text(nothing[k]);
    }
    return words;
}

std::vector<std::string> assumed_facts(const DepthMeaning& meaning) {
    std::vector<std::string> names;
    const DepthStatement known = meaning.statement();
    visit_facts(known, meaning, [&names](const char* name, const auto& value, const auto& fact) {
        if (value && fact.origin == Origin::assumed) names.emplace_back(name);
    });
    return names;
}

}  // namespace dibhr
