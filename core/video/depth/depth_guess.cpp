// Measures pictures on a lattice of pixels; each piece of evidence is a row of findings.
#include "core/video/depth/depth_guess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "core/files/plain_text.hpp"
#include "core/video/depth/mean_level.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

constexpr int kLatticePixels = 12000;  ///< about as many are taken of each picture

// No data.
constexpr double kLeastNone = 5e-4;  ///< least share of pixels for a sensor's holes
constexpr double kGap = 0.05;        ///< part of the levels' range that is too near for sensors
constexpr double kGapOfZero = 0.02;  ///< likewise of 0: sensors see far behind their nearest
constexpr double kStandsOut8 = 4.0;  ///< least ratio of zeros to pixels of levels 1 to 3
constexpr double kMostBelowWhite = 0.005;  ///< of 8 bits, where white is around a thing
constexpr double kGapOfAny = 0.25;         ///< of the span, below values that are no usual mark
constexpr double kGapAbove = 1.0;          ///< likewise above them, where a back wall may be
constexpr double kMostOfBorder = 0.9;
constexpr double kMostOfFrame = 0.35;  ///< share of the pixels in a constant border
constexpr double kFarBeyond = 5.0;     ///< times as far, or as near, as the other values
constexpr double kTailOfSpan = 0.05;
constexpr int kMostMarks = 4;             ///< values of no data in one source
constexpr std::size_t kLeastValues = 16;  ///< different ones, in depth that has marks
constexpr double kSurenessOfMark = 0.95;
constexpr double kSurenessOfNoMark = 0.8;  ///< holes may look like data

// Unit.
constexpr double kReachesEnd = 0.02;     ///< of 1, for values normalised to 0 to 1
constexpr double kReachesZero = 0.005;   ///< of the highest: no distance of a scene is as near
constexpr double kReachesTop = 0.9;      ///< of the highest level of the bits
constexpr double kMostScattered = 0.4;   ///< share of pixels with data without data beside them
constexpr double kFlat = 1.3;            ///< farthest to nearest of what is hardly a scene
constexpr double kFar_mm = 3000.0;       ///< so far away hardly anything is flat
constexpr double kClose_mm = 1000.0;     ///< numbers below may be centimetres of a room as well
constexpr double kTooClose_mm = 100.0;   ///< sensors of scenes do not see as near
constexpr double kManyTimes = 10.0;      ///< as far as the nearest is what no close-up has
constexpr double kLeastOfCloseUp = 5.0;  ///< scenes in metres mostly begin nearer
constexpr double kMostOfSmall = 30.0;
constexpr double kMostOfCloseUp = 100.0;  ///< a larger one is as flat as this:
constexpr double kFlatCloseUp = 4.0;      ///< farthest to nearest
constexpr double kImplausible = 0.05;
constexpr double kHardlyPlausible = 0.35;

// Range.
constexpr double kTail = 0.005;
constexpr double kVeryTail = 1e-4;
constexpr double kBeyondTail = 0.05;  ///< of the span
constexpr double kBeyondVeryTail = 0.02;
constexpr double kNearest = 0.9;
constexpr double kOutlier = 1.0;  ///< of the span of the nearest kNearest: beyond are outliers

bool holds(const std::vector<double>& levels, double level) {
    return std::find(levels.begin(), levels.end(), level) != levels.end();
}

std::vector<float> without(std::vector<float> levels, const std::vector<double>& no_data) {
    std::erase_if(levels, [&no_data](float level) { return holds(no_data, level); });
    return levels;
}

/// Quantile of values in rising order; `share` in [0, 1].
template <typename Value>
double quantile(const std::vector<Value>& rising, double share) {
    const auto last = static_cast<double>(rising.size() - 1);
    return rising[static_cast<std::size_t>(std::lround(share * last))];
}

double share_between(const std::vector<float>& rising, double lowest, double highest) {
    const auto begin = std::lower_bound(rising.begin(), rising.end(), lowest);
    const auto end = std::upper_bound(begin, rising.end(), highest);
    return static_cast<double>(end - begin) / static_cast<double>(rising.size());
}

/// The sizes of scenes, as distances of the nearest and of nine tenths of the pixels [m].
struct Sizes {
    double nearest_from, nearest_to, farthest_from, farthest_to;
    double hardly_to;  ///< a farthest distance that still happens
    const char* name;

    [[nodiscard]] double plausibility(double nearest_m, double farthest_m) const {
        if (nearest_m < nearest_from || nearest_m > nearest_to || farthest_m < farthest_from)
            return kImplausible;
        if (farthest_m <= farthest_to) return 1.0;
        return farthest_m <= hardly_to ? kHardlyPlausible : kImplausible;
    }
};

constexpr Sizes kRoom{0.02, 10.0, 0.15, 12.0, 20.0, "a room"};
constexpr Sizes kStreet{2.0, 20.0, 20.0, 90.0, 90.0, "a street"};
constexpr Sizes kLand{0.5, 50.0, 10.0, 400.0, 400.0, "open land"};

/// A way in which 16-bit integers hold distances, and how sure it is where the sizes fit.
struct IntegerScale {
    DepthUnit unit;
    double scale;
    const Sizes& sizes;
    double sureness;
    double of_flat;  ///< the same for a picture of hardly any depth
    double of_sky;   ///< the same where the highest level is no data
    /// The same where all is within a metre, or some of a scene too near for a sensor, without the
    /// holes of one.
    double of_close;
    double of_laser;  ///< the same where single pixels have data that fit a street
    double of_turn;   ///< the same in the size of a spinning LiDAR's pictures
};

constexpr std::array<IntegerScale, 5> kIntegerScales{{
    {DepthUnit::mm, 1.0, kRoom, 0.86, 0.74, 0.6, 0.5, 0.4, 0.4},
    {DepthUnit::mm, 0.2, kRoom, 0.1, 0.1, 0.1, 0.1, 0.1, 0.02},           // TUM: 5000 a metre
    {DepthUnit::m, 1.0 / 256.0, kStreet, 0.1, 0.1, 0.1, 0.1, 0.9, 0.05},  // street data sets
    {DepthUnit::mm, 10.0, kLand, 0.06, 0.1, 0.3, 0.3, 0.06, 0.05},        // simulators: centimetres
    // Ouster's range images (github.com/ouster-lidar/ouster-ros, os_image); else nobody's.
    {DepthUnit::mm, 4.0, kLand, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6},
}};

/// Whether pictures have a row for each laser of a spinning LiDAR, and a column for each of the
/// usual steps of its turn.
bool is_of_turn(cv::Size picture) {
    constexpr std::array kLasers{16, 32, 64, 128};
    constexpr std::array kSteps{512, 1024, 2048, 4096};
    return std::find(kLasers.begin(), kLasers.end(), picture.height) != kLasers.end() &&
           std::find(kSteps.begin(), kSteps.end(), picture.width) != kSteps.end();
}

/// "as numbers of 1 mm from 0.5 to 4.2 m: a room".
std::string sizes_text(const IntegerScale& scale, double nearest_m, double farthest_m, bool fits) {
    return "as numbers of " + short_text(scale.scale, 3) + ' ' + std::string(name_of(scale.unit)) +
           " from " + short_text(nearest_m, 3) + " to " + short_text(farthest_m, 3) +
           " m: " + (fits ? "" : "not ") + scale.sizes.name;
}

/// Values in which elevation is linear, with the sign that makes the nearest the highest, in rising
/// order.
std::vector<double> nearness_of(const std::vector<float>& levels, const DepthMeaning& meaning) {
    const double sign = meaning.near.value == NearLevels::bright ? 1.0 : -1.0;
    const bool disparity = meaning.unit.value == DepthUnit::disparity;
    std::vector<double> nearness;
    nearness.reserve(levels.size());
    for (const float level : levels) {
        const double value = level * meaning.scale.value;
        if (disparity && !(value > 0.0)) continue;
        nearness.push_back(disparity ? -sign / value : sign * value);
    }
    std::sort(nearness.begin(), nearness.end());
    return nearness;
}

/// The farthest value that is no outlier: sensors report some points far behind walls.
double farthest_of(const std::vector<double>& nearness, double nearest, bool has_outliers) {
    if (!has_outliers) return quantile(nearness, kTail);
    const double most = quantile(nearness, 1.0 - kNearest);
    const double fence = most - kOutlier * (nearest - most);
    const auto first = std::lower_bound(nearness.begin(), nearness.end(), fence);
    return quantile(std::vector<double>(first, nearness.end()), kTail);
}

/// Makes the ends of a range differ, for a picture of one plane: upwards, but for levels that are
/// the `highest` of their bits.
DepthRange not_empty(DepthRange range, const DepthMeaning& meaning, double highest) {
    if (range.near != range.far) return range;
    const bool is_bright = meaning.near.value == NearLevels::bright;
    const double some = std::max(std::fabs(range.far), meaning.scale.value);
    if (meaning.unit.value == DepthUnit::levels && range.far >= highest * meaning.scale.value)
        (is_bright ? range.far : range.near) -= some;
    else
        (is_bright ? range.near : range.far) += some;
    return range;
}

/// How an end of the levels differs from the others.
struct EndOfLevels {
    double level;
    double next;  ///< the value beside it
    double gap;   ///< to that, in spans of the others
    double share;
    bool at_bottom;
    bool is_border;  ///< the picture's border has it
};

/// 9999, 100000, 65504: nobody measures these.
bool is_usual_mark(double level) {
    const double zeros = std::log10(std::max(level, 1.0));
    const double nines = std::log10(std::max(level, 1.0) + 1.0);
    return level > 50.0 && (zeros == std::round(zeros) || nines == std::round(nines) ||
                            level == 65504.0 || level == 65535.0);
}

/// A wall behind a thing, or a table below it, is no mark: a mark is far beyond, or a frame.
bool is_mark(const EndOfLevels& end) {
    if (end.level == 0.0) return end.gap > kGap;
    if (end.is_border && end.share < kMostOfFrame) return end.gap > kGap;
    const double least = kFarBeyond * std::fabs(end.at_bottom ? end.level : end.next);
    const double most = std::fabs(end.at_bottom ? end.next : end.level);
    const bool is_beyond = end.level < 0.0 || most > least || is_usual_mark(end.level);
    return is_beyond && end.gap > (end.at_bottom ? kGapOfAny : kGapAbove);
}

std::size_t different_values(const std::vector<float>& rising) {
    std::size_t count = rising.empty() ? 0 : 1;
    for (std::size_t k = 1; k < rising.size(); ++k)
        count += static_cast<std::size_t>(rising[k] != rising[k - 1]);
    return count;
}

template <typename Level>
void mark_levels(const cv::Mat& grey, std::vector<char>& used) {
    for (int j = 0; j < grey.rows; ++j) {
        const auto* const row = grey.ptr<Level>(j);
        for (int i = 0; i < grey.cols; ++i) used[row[i]] = 1;
    }
}

void keep_different(std::vector<float>& levels) {
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
}

/// Adds those that are finite. Keeps at most about twice as many as there are different ones.
void add_real_levels(const cv::Mat& grey, std::vector<float>& used) {
    std::size_t most = std::max(2 * used.size(), std::size_t{1} << 20U);
    cv::Mat levels;
    for (int j = 0; j < grey.rows; ++j) {
        grey.row(j).convertTo(levels, CV_32F);
        const float* const row = levels.ptr<float>();
        std::copy_if(row, row + levels.cols, std::back_inserter(used),
                     [](float level) { return std::isfinite(level); });
        if (used.size() < most) continue;
        keep_different(used);
        most = std::max(2 * used.size(), most);
    }
}

}  // namespace

SampledLevels::SampledLevels(const std::vector<cv::Mat>& pictures, int bits) : bits_(bits) {
    if (!pictures.empty()) picture_ = pictures.front().size();
    lattices_.reserve(pictures.size());
    for (const cv::Mat& picture : pictures) lattices_.push_back(lattice_of(picture));
    for (const LevelLattice& lattice : lattices_)
        std::copy_if(lattice.levels.begin(), lattice.levels.end(), std::back_inserter(levels_),
                     [](float level) { return std::isfinite(level); });
    std::sort(levels_.begin(), levels_.end());
}

LevelLattice SampledLevels::lattice_of(const cv::Mat& picture) {
    const int step = std::max(
        1, static_cast<int>(std::sqrt(static_cast<double>(picture.total()) / kLatticePixels)));
    const cv::Mat grey = grey_of(picture);
    LevelLattice lattice;
    lattice.columns = (grey.cols + step - 1) / step;
    cv::Mat levels;
    for (int j = 0; j < grey.rows; j += step) {
        grey.row(j).convertTo(levels, CV_32F);
        const float* const row = levels.ptr<float>();
        for (int i = 0; i < grey.cols; i += step) {
            lattice.levels.push_back(row[i]);
            lattice.beside.push_back(row[std::min(i + 1, grey.cols - 1)]);
        }
        ++lattice.rows;
    }
    return lattice;
}

bool SampledLevels::is_data(float level) const {
    return std::isfinite(level) && !holds(no_data_, level);
}

void SampledLevels::leave_out(const std::vector<double>& no_data) {
    no_data_ = no_data;
    levels_ = without(std::move(levels_), no_data);
}

// No data.

Findings SampledLevels::no_data() const {
    const std::vector<double> marks = bits_ == kRealBits ? outlying_numbers() : outlying_integers();
    if (marks.empty())
        return {{{.no_data = marks},
                 Evidence::numbers,
                 kSurenessOfNoMark,
                 "no level stands out from the others"}};
    std::string reason;
    for (const double mark : marks) reason += (reason.empty() ? "" : " and ") + short_text(mark);
    return {{{.no_data = marks},
             Evidence::numbers,
             kSurenessOfMark,
             reason + (marks.size() == 1 ? " stands" : " stand") + " out from the other levels"}};
}

std::vector<double> SampledLevels::outlying_integers() const {
    if (levels_.empty()) return {};
    const double zeros = share_between(levels_, 0.0, 0.0);
    if (bits_ == 8) {
        const bool stands_out = zeros > kStandsOut8 * share_between(levels_, 1.0, 3.0);
        if (zeros > kLeastNone && stands_out) return {0.0};
        const bool is_around = share_of_border(255.0) >= kMostOfBorder;
        return is_around && share_between(levels_, 240.0, 254.0) < kMostBelowWhite
                   ? std::vector{255.0}
                   : std::vector<double>{};
    }
    const double highest = highest_level(bits_);
    const std::vector<float> others = without(levels_, {0.0, highest});
    if (others.empty()) return zeros > 0.0 ? std::vector{0.0} : std::vector<double>{};
    const double nearest = quantile(others, kTail);
    std::vector<double> none;
    if (zeros > kLeastNone && nearest > kGapOfZero * quantile(others, kNearest))
        none.push_back(0.0);
    const double tops = share_between(levels_, highest, highest);
    if (tops > 0.0 && highest - quantile(others, 1.0 - kTail) > kGap * highest)
        none.push_back(highest);
    return none;
}

double SampledLevels::share_of_border(double level) const {
    Mean border;
    for (const LevelLattice& lattice : lattices_) {
        auto here = lattice.levels.begin();
        for (int j = 0; j < lattice.rows; ++j)
            for (int i = 0; i < lattice.columns; ++i, ++here) {
                const bool inside =
                    j > 0 && i > 0 && j + 1 < lattice.rows && i + 1 < lattice.columns;
                if (!inside) border.add(static_cast<double>(*here) == level ? 1.0 : 0.0);
            }
    }
    return border.count > 0.0 ? border.value() : 0.0;
}

/// Takes marks from either end until none is left: a mark below may hide behind one above.
std::vector<double> SampledLevels::outlying_numbers() const {
    std::vector<double> marks;
    std::vector<float> rest = levels_;
    const auto all = static_cast<double>(levels_.size());
    for (int k = 0; k < kMostMarks; ++k) {
        bool found = false;
        for (const bool at_bottom : {true, false}) {
            if (rest.empty()) return marks;
            const float level = at_bottom ? rest.front() : rest.back();
            const auto [begin, end] = std::equal_range(rest.begin(), rest.end(), level);
            if (static_cast<double>(end - begin) < kLeastNone * all) continue;
            std::vector<float> others(rest.begin(), begin);
            others.insert(others.end(), end, rest.end());
            if (different_values(others) < kLeastValues) continue;
            const double next = at_bottom ? others.front() : others.back();
            const double span = quantile(others, 1.0 - kTailOfSpan) - quantile(others, kTailOfSpan);
            const double gap = std::fabs(next - static_cast<double>(level));
            const bool is_border = share_of_border(level) >= kMostOfBorder;
            const double share = static_cast<double>(end - begin) / all;
            if (!is_mark({level, next, span > 0.0 ? gap / span : 0.0, share, at_bottom, is_border}))
                continue;
            marks.push_back(level);
            rest = std::move(others);
            found = true;
        }
        if (!found) break;
    }
    std::sort(marks.begin(), marks.end());
    return marks;
}

// Unit and scale.

/// Whether few pixels have data, most of them without a neighbour, as a laser sees a scene.
bool SampledLevels::is_scattered() const {
    constexpr double kMostSeen = 0.6;
    Mean seen;
    Mean single;
    for (const LevelLattice& lattice : lattices_)
        for (std::size_t k = 0; k < lattice.levels.size(); ++k) {
            const bool here = is_data(lattice.levels[k]);
            seen.add(here ? 1.0 : 0.0);
            if (here) single.add(is_data(lattice.beside[k]) ? 0.0 : 1.0);
        }
    return single.count > 0.0 && seen.value() < kMostSeen && single.value() > kMostScattered;
}

Findings SampledLevels::units() const {
    if (levels_.empty()) return {};
    return bits_ == kRealBits ? units_of_numbers() : units_of_integers();
}

Findings SampledLevels::units_of_integers() const {
    constexpr auto kNumbers = Evidence::numbers;
    if (bits_ == 8)
        return {{{.unit = DepthUnit::levels}, kNumbers, 0.98, "8 bits hold no distances"}};
    Findings rows{
        {{.unit = DepthUnit::disparity}, kNumbers, 0.08, "whole numbers are seldom disparities"},
        {{.unit = DepthUnit::m, .scale = 1.0}, kNumbers, 0.01, "whole metres are too coarse"}};
    const double nearest = quantile(levels_, kTail);
    const double farthest = quantile(levels_, kNearest);
    const bool has_holes = holds(no_data_, 0.0);
    const bool has_sky = holds(no_data_, highest_level(bits_));
    if (has_holes)
        rows.push_back({{.near = NearLevels::dark},
                        kNumbers,
                        0.8,
                        "0 stands for no data, as sensors of distances have it"});
    const bool is_full = quantile(levels_, 1.0 - kTail) >= kReachesTop * highest_level(bits_);
    if (!has_holes && (bits_ < 16 || is_full))
        rows.push_back({{.unit = DepthUnit::levels},
                        kNumbers,
                        0.93,
                        is_full ? "the levels reach the highest of their bits"
                                : "without holes, so few bits are levels"});
    if (!has_holes && bits_ < 16) return rows;
    const bool is_close =
        farthest < kClose_mm || (nearest < kTooClose_mm && farthest > kManyTimes * nearest);
    const bool is_flat = farthest < kFlat * nearest;
    const bool is_of_laser =
        kStreet.plausibility(nearest / 256.0, farthest / 256.0) == 1.0 && is_scattered();
    const bool is_turn = is_of_turn(picture_);
    const std::string where = is_turn       ? "with a row a laser of a spinning LiDAR, "
                              : is_of_laser ? "where a laser sees single pixels, "
                                            : "";
    for (const IntegerScale& scale : kIntegerScales) {
        const double in_m = scale.scale * (scale.unit == DepthUnit::m ? 1.0 : 0.001);
        const double fits = scale.sizes.plausibility(nearest * in_m, farthest * in_m);
        const double sureness = is_turn                                        ? scale.of_turn
                                : has_sky && !has_holes                        ? scale.of_sky
                                : is_flat && (!has_holes || nearest > kFar_mm) ? scale.of_flat
                                : is_close && !has_holes                       ? scale.of_close
                                : is_of_laser                                  ? scale.of_laser
                                                                               : scale.sureness;
        if (sureness == 0.0) continue;
        rows.push_back(
            {{.unit = scale.unit, .scale = scale.scale},
             kNumbers,
             sureness * fits,
             where + sizes_text(scale, nearest * in_m, farthest * in_m, fits > kImplausible)});
    }
    return rows;
}

Findings SampledLevels::units_of_numbers() const {
    const double lowest = quantile(levels_, kTail);
    const double highest = quantile(levels_, 1.0 - kTail);
    Findings rows;
    const auto add = [&rows](const DepthStatement& statement, double sureness,
                             const std::string& reason) {
        rows.push_back({statement, Evidence::numbers, sureness, reason});
    };
    const DepthStatement levels{.unit = DepthUnit::levels};
    add({.scale = 1.0}, 0.97, "real numbers need no scale");
    if (highest <= 0.0) {
        add(levels, 0.9, "all are below 0: distances or disparities with a minus sign");
        return rows;
    }
    if (lowest < 0.0) {
        add(levels, 0.97, "some are below 0: no distances, and not one over them");
        add({.near = NearLevels::bright}, 0.75, "relative values mostly rise towards the viewer");
        return rows;
    }
    if (lowest < kReachesZero * highest)
        add(levels, 0.85, "they reach 0: no distance is as near, and no disparity has one over it");
    const bool is_normalised = lowest < kReachesEnd && highest > 1.0 - kReachesEnd;
    if (highest <= 1.0)
        add(levels, is_normalised ? 0.93 : 0.55,
            is_normalised ? "they go from 0 to 1" : "they lie between 0 and 1");
    const std::string ends = short_text(lowest, 3) + " to " + short_text(highest, 3);
    const bool in_room = lowest >= 0.05 && highest > 1.0 && highest <= 30.0;
    const bool in_street = lowest >= 1.5 && lowest <= 15.0 && highest <= 100.0;
    // So far away, and so flat: it is as likely a tooth or a part in millimetres.
    const bool is_close_up = lowest >= kLeastOfCloseUp && highest <= kMostOfCloseUp &&
                             (highest <= kMostOfSmall || highest <= kFlatCloseUp * lowest);
    const bool in_metres = (in_room || in_street) && !is_close_up;
    add({.unit = DepthUnit::m, .scale = 1.0},
        in_metres           ? 0.9
        : highest <= 100.0  ? 0.4
        : highest <= 1000.0 ? 0.2
                            : 0.02,
        ends + (in_metres ? " is a scene in metres" : " is hardly a scene in metres"));
    if (is_close_up) {
        add({.unit = DepthUnit::mm, .scale = 1.0}, 0.4, ends + " is a close-up in millimetres");
        return rows;
    }
    const bool in_millimetres = lowest >= 50.0 && highest > 100.0 && highest <= 20000.0;
    const bool in_centimetres = lowest >= 20.0 && highest > 100.0 && highest < kClose_mm;
    add({.unit = DepthUnit::mm, .scale = 1.0},
        !in_millimetres  ? 0.02
        : in_centimetres ? 0.5
                         : 0.85,
        ends + (in_millimetres ? " is a scene in millimetres" : " is no scene in millimetres"));
    if (in_centimetres)
        add({.unit = DepthUnit::mm, .scale = 10.0}, 0.4, ends + " is a room in centimetres");
    return rows;
}

Findings SampledLevels::contradictions(const Findings& findings) const {
    Findings rows;
    for (const Finding& finding : findings)
        for (Finding& row : contradiction(finding)) rows.push_back(std::move(row));
    for (Finding& row : signed_disparity(findings)) rows.push_back(std::move(row));
    return rows;
}

/// Disparities about a plane, which is no infinity: those in front of it are above 0.
Findings SampledLevels::signed_disparity(const Findings& findings) const {
    constexpr double kLeastBelow = 0.02;  // share of pixels, and of the highest; else it is noise
    constexpr double kNoDisparity = 0.001;
    const auto is_disparity = [](const Finding& row) {
        return row.statement.unit == DepthUnit::disparity && row.sureness > 0.5;
    };
    const Finding* surest = nullptr;
    for (const Finding& row : findings)
        if (is_disparity(row) && (surest == nullptr || row.sureness > surest->sureness))
            surest = &row;
    if (surest == nullptr || bits_ != kRealBits || levels_.empty()) return {};
    const double highest = quantile(levels_, 1.0 - kTail);
    const double low = quantile(levels_, kLeastBelow);
    if (highest <= 0.0 || low >= -kLeastBelow * highest) return {};
    return {{{.unit = DepthUnit::disparity},
             Evidence::numbers,
             kNoDisparity,
             "some are below 0: not one over distances"},
            {{.near = NearLevels::bright, .unit = DepthUnit::levels},
             Evidence::numbers,
             surest->sureness,
             "disparities about a plane"}};
}

/// One row, or none.
Findings SampledLevels::contradiction(const Finding& finding) const {
    constexpr double kContradicted = 0.001;
    const UsualDistances& usual = finding.usual;
    const DepthStatement& said = finding.statement;
    if (levels_.empty() || usual.most_m <= 0.0 || !said.unit) return {};
    const double one_m = said.scale.value_or(1.0) * (said.unit == DepthUnit::m ? 1.0 : 0.001);
    const double nearest_m = one_m * quantile(levels_, kTail);
    const double farthest_m = one_m * quantile(levels_, kNearest);
    const bool reaches_far = usual.reach_m > 0.0 && farthest_m >= usual.reach_m;
    const bool is_usual = (nearest_m >= usual.least_m || reaches_far) && farthest_m <= usual.most_m;
    const bool has_holes = holes_share() > kLeastNone;
    if (is_usual && !(usual.is_dense && has_holes)) return {};
    const std::string ends = short_text(nearest_m, 3) + " to " + short_text(farthest_m, 3) + " m";
    return {{{.unit = said.unit, .scale = said.scale},
             Evidence::numbers,
             kContradicted,
             usual.of + " has no " + (is_usual ? "holes" : "depth from " + ends)}};
}

// Range.

DepthRange SampledLevels::range(const DepthMeaning& meaning) const {
    const double sign = meaning.near.value == NearLevels::bright ? 1.0 : -1.0;
    const bool disparity = meaning.unit.value == DepthUnit::disparity;
    const std::vector<double> nearness = nearness_of(levels_, meaning);
    const auto value = [&](double of) { return disparity ? -sign / of : sign * of; };
    if (nearness.empty()) return sign > 0.0 ? DepthRange{1.0, 0.0} : DepthRange{0.0, 1.0};
    const double most = quantile(nearness, 1.0 - kTail);
    const double least = farthest_of(nearness, most, meaning.is_metric() || disparity);
    const double span = most - least;
    // A few pixels beyond the near tail may be a fingertip.
    double near = std::max(most + kBeyondTail * span,
                           quantile(nearness, 1.0 - kVeryTail) + kBeyondVeryTail * span);
    near = std::min(near, nearness.back());
    double far = std::max(least - kBeyondTail * span, nearness.front());
    if (near == far) {  // a plane, or very little beside one
        near = nearness.back();
        far = nearness.front();
    }
    const double highest =
        bits_ == kRealBits ? std::numeric_limits<double>::infinity() : highest_level(bits_);
    return not_empty({value(near), value(far)}, meaning, highest);
}

/// Differences of levels side by side, both of them data.
std::vector<double> SampledLevels::steps() const {
    std::vector<double> steps;
    for (const LevelLattice& lattice : lattices_)
        for (std::size_t k = 0; k < lattice.levels.size(); ++k)
            if (is_data(lattice.levels[k]) && is_data(lattice.beside[k]))
                steps.push_back(std::fabs(static_cast<double>(lattice.levels[k]) -
                                          static_cast<double>(lattice.beside[k])));
    return steps;
}

/// Whether levels jump at places, as at outlines of things that a camera sees.
bool SampledLevels::has_outlines() const {
    constexpr double kLeastOfSpan = 0.1;
    constexpr double kLeastOfSteps = 0.002;
    if (levels_.empty()) return false;
    const double jump = kLeastOfSpan * (quantile(levels_, 1.0 - kTail) - quantile(levels_, kTail));
    const std::vector<double> all = steps();
    const auto jumps =
        std::count_if(all.begin(), all.end(), [jump](double step) { return step > jump; });
    return static_cast<double>(jumps) > kLeastOfSteps * static_cast<double>(all.size());
}

bool SampledLevels::may_be_terrain() const {
    constexpr double kDeepest_m = -11000.0;
    constexpr double kHighest_m = 8900.0;
    constexpr double kMostOfOthers = 100.0;
    constexpr double kAboutZero = 1.0;
    constexpr double kColdest_K = 220.0;
    constexpr double kHottest_K = 345.0;
    constexpr double kRough = 0.03;  // of the span, a pixel; terrain 0.005 to 0.022, slopes 0.06
    constexpr std::size_t kLeastHeights = 64;
    if (different_values(levels_) < kLeastHeights) return false;
    const double lowest = quantile(levels_, kTail);
    const double highest = quantile(levels_, 1.0 - kTail);
    const bool in_metres = lowest >= kDeepest_m && highest <= kHighest_m &&
                           (lowest < -kMostOfOthers || highest > kMostOfOthers);
    const bool in_kelvin = lowest >= kColdest_K && highest <= kHottest_K;
    Mean step;
    for (const double each : steps()) step.add(each);
    const bool is_smooth = step.count > 0.0 && step.value() <= kRough * (highest - lowest);
    return in_metres && !in_kelvin && std::fabs(lowest) > kAboutZero && is_smooth;
}

double SampledLevels::holes_share() const {
    std::size_t all = 0;
    for (const LevelLattice& lattice : lattices_) all += lattice.levels.size();
    return all == 0 ? 0.0 : static_cast<double>(all - levels_.size()) / static_cast<double>(all);
}

int levels_used(const std::vector<cv::Mat>& pictures) {
    constexpr std::size_t kWholeLevels = std::size_t{1} << 16U;
    std::vector<char> whole(kWholeLevels);  // 1: used
    std::vector<float> used;
    for (const cv::Mat& picture : pictures) {
        const cv::Mat grey = grey_of(picture);
        if (grey.depth() == CV_8U)
            mark_levels<std::uint8_t>(grey, whole);
        else if (grey.depth() == CV_16U)
            mark_levels<std::uint16_t>(grey, whole);
        else
            add_real_levels(grey, used);
    }
    for (std::size_t level = 0; level < kWholeLevels; ++level)
        if (whole[level] != 0) used.push_back(static_cast<float>(level));
    keep_different(used);
    return static_cast<int>(used.size());
}

}  // namespace dibhr
