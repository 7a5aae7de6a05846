// Compares whole words; the most telling one counts.
#include "core/video/depth/depth_words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

using NameWords = std::span<const std::string>;

constexpr std::array kOtherContents{
    OtherContent{"a mask", " mask masks valid validity "},
    OtherContent{"confidence", " conf confidence confidences certainty uncertainty "},
    OtherContent{"normals", " normal normals nor nrm "},
    OtherContent{"infrared", " ir infra infrared "},
    OtherContent{"brightness", " amplitude intensity ", false, true},
    OtherContent{"a preview", " thumb thumbs thumbnail thumbnails preview previews poster ", true},
    OtherContent{"a painting of depth",
                 " vis viz visualization visualisation visualized visualised colored coloured "
                 "colorized colourised colormap colourmap ",
                 true},
    OtherContent{"labels", " semantic semantics seg segmentation label labels instance instances "},
    OtherContent{"optical flow", " flow flows "},
    OtherContent{"another map of the material", " ao rough roughness metallic metalness opacity "},
    OtherContent{"temperature",
                 " temperature temperatures celsius kelvin fahrenheit thermal sst lst ", false,
                 false, true},
    OtherContent{"speed", " speed speeds velocity velocities wind ", false, false, true},
    OtherContent{"density", " density densities population ", false, false, true},
    OtherContent{"pressure", " pressure pressures ", false, false, true},
    OtherContent{"water", " humidity moisture precipitation rainfall salinity ", false, false,
                 true},
    OtherContent{"reflected light", " ndvi ndwi ndmi ndsi evi savi reflectance ", false, false,
                 true},
    OtherContent{"radar", " backscatter sar ", false, false, true},
    OtherContent{"slope", " slope slopes aspect curvature hillshade ", false, false, true}};

/// A word for values that are near where bright.
struct NearnessWord {
    std::string_view word;
    std::optional<DepthUnit> unit;
    double sureness;
};

constexpr std::array kNearnessWords{
    NearnessWord{"disp", DepthUnit::disparity, kSurenessOfName},
    NearnessWord{"disparity", DepthUnit::disparity, kSurenessOfName},
    NearnessWord{"disparities", DepthUnit::disparity, kSurenessOfName},
    NearnessWord{"idepth", DepthUnit::disparity, kSurenessOfName},
    NearnessWord{"invdepth", DepthUnit::disparity, kSurenessOfName},
    // Heights seen from above: high is near, and linear.
    NearnessWord{"height", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"heightmap", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"displacement", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"elevation", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"displacementmap", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"bump", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"bumpmap", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"dem", DepthUnit::levels, 0.92},  // also a German article
    NearnessWord{"dsm", DepthUnit::levels, 0.92}, NearnessWord{"dtm", DepthUnit::levels, 0.92},
    NearnessWord{"terrain", DepthUnit::levels, 0.92}, NearnessWord{"srtm", DepthUnit::levels, 0.92},
    NearnessWord{"chm", DepthUnit::levels, 0.92}, NearnessWord{"topo", DepthUnit::levels, 0.92},
    NearnessWord{"topography", DepthUnit::levels, kSurenessOfName},
    NearnessWord{"nearness", std::nullopt, kSurenessOfName},
    NearnessWord{"closeness", std::nullopt, kSurenessOfName}};

/// A word for distances of unknown unit; a probability of 0 gives no row. Programs that estimate
/// depth call their relative values so, too.
struct DistanceWord {
    std::string_view word;
    double dark;
    double levels;
    double metres;  ///< of real numbers
};

constexpr double kDarkOfDepth = 0.75;
constexpr double kLevelsOfDepth = 0.3;
constexpr std::string_view kChineseDepth = "\xe6\xb7\xb1\xe5\xba\xa6";
constexpr std::string_view kChineseMap = "\xe6\xb7\xb1\xe5\xba\xa6\xe5\x9b\xbe";  // of depth
constexpr std::array kDistanceWords{DistanceWord{"lidar", 0.97, 0.1, 0.9},
                                    DistanceWord{"velodyne", 0.97, 0.1, 0.9},
                                    DistanceWord{"metric", 0.97, 0.05, 0.0},
                                    DistanceWord{"distance", 0.9, 0.3, 0.5},
                                    DistanceWord{"distances", 0.9, 0.3, 0.5},
                                    DistanceWord{"range", 0.8, 0.0, 0.5},  // also of values
                                    DistanceWord{"depth", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"depths", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"depthmap", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"depthmaps", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"tiefe", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"tiefen", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"tiefenbild", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"tiefenkarte", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"profondeur", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"profundidad", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{"profondita", kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{kChineseDepth, kDarkOfDepth, kLevelsOfDepth, 0.0},
                                    DistanceWord{kChineseMap, kDarkOfDepth, kLevelsOfDepth, 0.0}};

/// Beside these, a word for depth does not mean distances.
constexpr std::array<std::string_view, 13> kRelativeWords{
    "rel",  "relative", "norm", "normalized", "normalised", "linear",  "log",
    "mist", "zbuffer",  "dpt",  "midas",      "marigold",   "anything"};

/// A unit in all its words. The first, a short one, counts only beside a word for distances, or
/// after "in".
struct UnitOfDistance {
    DepthUnit unit;
    double scale;
    std::array<std::string_view, 5> words;
};

constexpr std::array<UnitOfDistance, 3> kUnitsOfDistance{{
    {DepthUnit::mm, 1.0, {"mm", "millimeter", "millimeters", "millimetre", "millimetres"}},
    {DepthUnit::mm, 10.0, {"cm", "centimeter", "centimeters", "centimetre", "centimetres"}},
    {DepthUnit::m, 1.0, {"m", "meter", "meters", "metre", "metres"}},
}};

bool has_name_word(NameWords words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string quoted_word(std::string_view word, std::string_view whose) {
    return in_quotes(word) + " in " + std::string(whose);
}

/// "inv_depth", "inverse depth".
bool is_of_inverse(NameWords words) {
    const auto is_inverse = [](const std::string& word) {
        return word == "inv" || word == "inverse" || word == "reciprocal";
    };
    const auto at = std::find_if(words.begin(), words.end(), is_inverse);
    return at != words.end() && at + 1 != words.end() &&
           (at[1] == "depth" || at[1] == "distance" || at[1] == "z");
}

/// "log_depth", "logDepth".
bool is_of_logarithm(NameWords words) {
    const auto at = std::find(words.begin(), words.end(), "log");
    return at != words.end() && at + 1 != words.end() &&
           (at[1] == "depth" || at[1] == "distance" || at[1] == "z");
}

/// "rock_wall_disp_4k": a displacement, of as many pixels. A number and its letter are two words.
bool is_of_texture(NameWords words) {
    constexpr std::array<std::string_view, 5> kThousands{"1", "2", "4", "8", "16"};
    for (std::size_t at = 1; at < words.size(); ++at)
        if (words[at] == "k" &&
            std::find(kThousands.begin(), kThousands.end(), words[at - 1]) != kThousands.end())
            return true;
    return false;
}

const DistanceWord* distance_word(NameWords words) {
    const auto* const found = std::find_if(
        kDistanceWords.begin(), kDistanceWords.end(),
        [words](const DistanceWord& known) { return has_name_word(words, known.word); });
    return found == kDistanceWords.end() ? nullptr : found;
}

/// Whether that word of the name is the unit of the distances that the name speaks of: no size
/// ("shot_10m") and, as a single letter, directly behind them.
bool is_unit_at(NameWords words, std::size_t at, const UnitOfDistance& unit) {
    const std::string& word = words[at];
    if (std::find(unit.words.begin(), unit.words.end(), word) == unit.words.end()) return false;
    const bool is_short = word == unit.words.front();
    const bool may_be_apart = !is_short || (word.size() > 1 && distance_word(words) != nullptr);
    if (at == 0) return may_be_apart;
    const std::string& before = words[at - 1];
    return !is_decimal_digit(before.front()) && (may_be_apart || before == "in" || before == "z" ||
                                                 distance_word({&before, 1}) != nullptr);
}

/// On the unit of the distances in a name; empty: the name has none.
Findings findings_on_unit(NameWords words, int bits, std::string_view whose) {
    constexpr double kLeast_m = 0.001;
    constexpr double kMost_m = 2000.0;
    constexpr double kMostOfWhole_m = 100.0;  // whole metres of a larger scene are of another unit
    for (const UnitOfDistance& unit : kUnitsOfDistance)
        for (std::size_t at = 0; at < words.size(); ++at)
            if (is_unit_at(words, at, unit)) {
                const bool is_whole = bits != kRealBits && unit.unit == DepthUnit::m;
                return {{{.near = NearLevels::dark, .unit = unit.unit, .scale = unit.scale},
                         Evidence::name,
                         kSurenessOfName,
                         quoted_word(words[at], whose),
                         {},
                         {"a scene", kLeast_m, is_whole ? kMostOfWhole_m : kMost_m}}};
            }
    return {};
}

Findings findings_on_distance(const DistanceWord& known, int bits, std::string_view whose) {
    const std::string reason = quoted_word(known.word, whose);
    Findings rows{{{.near = NearLevels::dark}, Evidence::name, known.dark, reason}};
    if (known.levels > 0.0)
        rows.push_back({{.unit = DepthUnit::levels}, Evidence::name, known.levels, reason});
    if (known.metres > 0.0 && bits == kRealBits)
        rows.push_back(
            {{.unit = DepthUnit::m, .scale = 1.0}, Evidence::name, known.metres, reason});
    return rows;
}

}  // namespace

const OtherContent* other_content_of(std::string_view word) {
    const std::string between_blanks = ' ' + std::string(word) + ' ';
    const auto* const found = std::find_if(
        kOtherContents.begin(), kOtherContents.end(), [&](const OtherContent& content) {
            return content.words.find(between_blanks) != std::string_view::npos;
        });
    return found == kOtherContents.end() ? nullptr : found;
}

Findings findings_in_name(std::string_view name, int bits, std::string_view whose) {
    const std::vector<std::string> all = words_of_name(name);
    const NameWords words(all);
    if (is_of_inverse(words))
        return {{{.near = NearLevels::bright, .unit = DepthUnit::disparity},
                 Evidence::name,
                 kSurenessOfName,
                 "inverse depth in " + std::string(whose)}};
    for (const NearnessWord& known : kNearnessWords)
        if (has_name_word(words, known.word))
            return {{{.near = NearLevels::bright,
                      .unit = is_of_texture(words) ? DepthUnit::levels : known.unit},
                     Evidence::name,
                     known.sureness,
                     quoted_word(known.word, whose)}};
    if (bits <= 8) return {};
    if (is_of_logarithm(words))
        return {{{.near = NearLevels::dark, .unit = DepthUnit::levels},
                 Evidence::name,
                 kSurenessOfName,
                 "a logarithm of depth in " + std::string(whose)}};
    if (Findings rows = findings_on_unit(words, bits, whose); !rows.empty()) return rows;
    const bool is_relative =
        std::any_of(kRelativeWords.begin(), kRelativeWords.end(),
                    [words](std::string_view word) { return has_name_word(words, word); });
    const DistanceWord* const distance = is_relative ? nullptr : distance_word(words);
    return distance == nullptr ? Findings{} : findings_on_distance(*distance, bits, whose);
}

Findings quantities_in_name(std::string_view name, std::string_view whose) {
    const std::vector<std::string> words = words_of_name(name);
    for (auto word = words.rbegin(); word != words.rend(); ++word) {
        const OtherContent* const other = other_content_of(*word);
        if (other != nullptr && other->is_quantity)
            return {{{},
                     Evidence::name,
                     kSurenessOfName,
                     std::string(whose) + " speaks of " + std::string(other->what) + " (" +
                         in_quotes(*word) + ")",
                     std::string(kNoDepth)}};
        const auto names_it = [word](const auto& known) { return known.word == *word; };
        if (std::any_of(kNearnessWords.begin(), kNearnessWords.end(), names_it) ||
            std::any_of(kDistanceWords.begin(), kDistanceWords.end(), names_it))
            break;
    }
    return {};
}

}  // namespace dibhr
