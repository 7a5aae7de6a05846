// Measures pictures on a lattice of pixels, and decides fact by fact.
#include "core/video/depth/depth_guess.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <set>

#include "core/video/depth/depth_scale.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

constexpr int kLatticePixels = 12000;  ///< about as many are taken of each picture

// No data.
constexpr double kLeastNone = 5e-4;  ///< least share of pixels for a sensor's holes
constexpr double kGap = 0.05;        ///< part of the levels' range that is too near for sensors
constexpr double kStandsOut8 = 4.0;  ///< least ratio of zeros to pixels of levels 1 to 3

// Unit.
constexpr double kFarthest_mm = 20000.0;
constexpr double kUsualFarthest_mm = 12000.0;
constexpr double kFifthsOfMillimetre = 0.2;
constexpr double kMostMetres = 100.0;

constexpr double kClear = 0.25;  ///< deviations by which middle and floor must differ

// Range.
constexpr double kTail = 0.005;
constexpr double kVeryTail = 1e-4;
constexpr double kBeyondTail = 0.05;  ///< of the span
constexpr double kBeyondVeryTail = 0.02;
constexpr double kNearest = 0.9;
constexpr double kOutlier = 1.0;  ///< of the span of the nearest kNearest: beyond are outliers

/// One picture's levels on a lattice.
struct Lattice {
    int columns{0}, rows{0};
    std::vector<float> levels{};
};

Lattice lattice_of(const cv::Mat& picture) {
    const int step = std::max(
        1, static_cast<int>(std::sqrt(static_cast<double>(picture.total()) / kLatticePixels)));
    cv::Mat all;
    grey_of(picture).convertTo(all, CV_32F);
    Lattice lattice;
    lattice.columns = (all.cols + step - 1) / step;
    for (int j = 0; j < all.rows; j += step) {
        const float* row = all.ptr<float>(j);
        for (int i = 0; i < all.cols; i += step) lattice.levels.push_back(row[i]);
        ++lattice.rows;
    }
    return lattice;
}

bool holds(const std::vector<double>& levels, double level) {
    return std::find(levels.begin(), levels.end(), level) != levels.end();
}

/// The levels of all lattices without no data, in rising order.
std::vector<float> sorted_levels(const std::vector<Lattice>& lattices,
                                 const std::vector<double>& no_data) {
    std::vector<float> levels;
    for (const Lattice& lattice : lattices) {
        for (const float level : lattice.levels) {
            if (std::isfinite(level) && !holds(no_data, level)) levels.push_back(level);
        }
    }
    std::sort(levels.begin(), levels.end());
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

std::vector<double> guess_no_data(const std::vector<Lattice>& lattices, int bits) {
    const std::vector<float> levels = sorted_levels(lattices, {});
    if (levels.empty() || bits == kRealBits) return {};
    const double zeros = share_between(levels, 0.0, 0.0);
    if (bits == 8) {
        const bool stands_out = zeros > kStandsOut8 * share_between(levels, 1.0, 3.0);
        return zeros > kLeastNone && stands_out ? std::vector{0.0} : std::vector<double>{};
    }
    const double highest = highest_level(bits);
    const std::vector<float> others = sorted_levels(lattices, {0.0, highest});
    if (others.empty()) return zeros > 0.0 ? std::vector{0.0} : std::vector<double>{};
    const double nearest = quantile(others, kTail);
    std::vector<double> none;
    if (zeros > kLeastNone && nearest > kGap * quantile(others, kNearest)) none.push_back(0.0);
    const double tops = share_between(levels, highest, highest);
    if (tops > 0.0 && highest - quantile(others, 1.0 - kTail) > kGap * highest)
        none.push_back(highest);
    return none;
}

struct Mean {
    double sum{0.0};
    double squares{0.0};
    double count{0.0};

    void add(double level) {
        sum += level;
        squares += level * level;
        count += 1.0;
    }
    [[nodiscard]] double value() const { return sum / count; }
    [[nodiscard]] double deviation() const {
        return std::sqrt(std::max(squares / count - value() * value(), 0.0));
    }
};

/// Mean levels of areas of the picture.
struct Places {
    Mean all{}, middle{}, border{}, floor{}, top{};

    /// `x` and `y`: from the middle, in [-0.5, 0.5].
    void add(double x, double y, double level) {
        all.add(level);
        if (std::fabs(x) < 0.25 && std::fabs(y) < 0.25) middle.add(level);
        if (std::fabs(x) > 0.4 || y < -0.4) border.add(level);
        if (y > 0.3) floor.add(level);
        if (y < -0.3) top.add(level);
    }
};

/// How many standard deviations brighter the picture's middle is than its border, plus its floor
/// than its top; negative: darker. Near objects are mostly in the middle, and on a floor.
double brighter_where_near(const std::vector<Lattice>& lattices,
                           const std::vector<double>& no_data) {
    Places places;
    for (const Lattice& lattice : lattices) {
        auto level = lattice.levels.begin();
        for (int j = 0; j < lattice.rows; ++j) {
            for (int i = 0; i < lattice.columns; ++i, ++level) {
                if (!std::isfinite(*level) || holds(no_data, *level)) continue;
                places.add((i + 0.5) / lattice.columns - 0.5, (j + 0.5) / lattice.rows - 0.5,
                           *level);
            }
        }
    }
    const double deviation = places.all.count > 0.0 ? places.all.deviation() : 0.0;
    const auto brighter = [deviation](const Mean& here, const Mean& there) {
        const bool both = here.count > 0.0 && there.count > 0.0 && deviation > 0.0;
        return both ? (here.value() - there.value()) / deviation : 0.0;
    };
    return brighter(places.middle, places.border) + brighter(places.floor, places.top);
}

/// A unit, and the size of one level in it.
struct Scaled {
    DepthUnit unit;
    double scale;
};

Scaled guess_integers(const std::vector<float>& levels, const std::vector<double>& no_data,
                      int bits) {
    if (bits == 8 || levels.empty()) return {DepthUnit::levels, 1.0};
    const double farthest = quantile(levels, kNearest);
    const bool has_holes = holds(no_data, 0.0);
    if (bits == 16 && farthest <= kUsualFarthest_mm) return {DepthUnit::mm, 1.0};
    if (!has_holes) return {DepthUnit::levels, 1.0};
    if (farthest > kFarthest_mm) return {DepthUnit::mm, kFifthsOfMillimetre};
    return {DepthUnit::mm, 1.0};
}

DepthUnit guess_real_numbers(const std::vector<float>& levels, double brighter) {
    if (levels.empty()) return DepthUnit::levels;
    const double highest = quantile(levels, 1.0 - kTail);
    if (brighter > kClear) return highest <= 1.0 ? DepthUnit::levels : DepthUnit::disparity;
    if (highest > kMostMetres) return DepthUnit::mm;
    return brighter < -kClear || highest > 1.0 ? DepthUnit::m : DepthUnit::levels;
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

/// Makes the ends of a range differ, for a picture of one plane.
DepthRange not_empty(DepthRange range, const DepthMeaning& meaning) {
    if (range.near != range.far) return range;
    const double some = std::max(std::fabs(range.far), meaning.scale.value);
    (meaning.near.value == NearLevels::bright ? range.near : range.far) += some;
    return range;
}

DepthRange guess_range(const std::vector<float>& levels, const DepthMeaning& meaning) {
    const double sign = meaning.near.value == NearLevels::bright ? 1.0 : -1.0;
    const bool disparity = meaning.unit.value == DepthUnit::disparity;
    const std::vector<double> nearness = nearness_of(levels, meaning);
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
    return not_empty({value(near), value(far)}, meaning);
}

/// A function that tells whether any statement has a fact of DepthStatement.
auto stated_by_any(const RankedStatements& statements) {
    return [&statements](auto fact) {
        return std::any_of(statements.begin(), statements.end(),
                           [&](const auto& ranked) { return (ranked.second.*fact).has_value(); });
    };
}

}  // namespace

bool is_all_stated(const RankedStatements& statements) {
    const auto states = stated_by_any(statements);
    return states(&DepthStatement::no_data) && states(&DepthStatement::unit) &&
           states(&DepthStatement::scale) && states(&DepthStatement::near) &&
           states(&DepthStatement::range);
}

void guess(const std::vector<cv::Mat>& pictures, int bits, DepthMeaning& meaning,
           const RankedStatements& statements) {
    std::vector<Lattice> lattices;
    lattices.reserve(pictures.size());
    for (const cv::Mat& picture : pictures) lattices.push_back(lattice_of(picture));
    const auto states = stated_by_any(statements);
    if (!states(&DepthStatement::no_data)) meaning.no_data.value = guess_no_data(lattices, bits);
    const std::vector<double>& no_data = meaning.no_data.value;
    const std::vector<float> levels = sorted_levels(lattices, no_data);
    const double brighter = brighter_where_near(lattices, no_data);
    if (!states(&DepthStatement::unit)) {
        const Scaled scaled = bits == kRealBits ? Scaled{guess_real_numbers(levels, brighter), 1.0}
                                                : guess_integers(levels, no_data, bits);
        meaning.unit.value = scaled.unit;
        if (!states(&DepthStatement::scale)) meaning.scale.value = scaled.scale;
    } else if (!states(&DepthStatement::scale)) {
        meaning.scale = {1.0, meaning.unit.origin};
    }
    if (!states(&DepthStatement::near)) {
        const bool by_unit = meaning.unit.value != DepthUnit::levels;
        const bool dark = by_unit ? meaning.is_metric() : brighter < -kClear;
        meaning.near = {dark ? NearLevels::dark : NearLevels::bright,
                        by_unit ? meaning.unit.origin : Origin::assumed};
        if (states(&DepthStatement::range) && !by_unit) {
            const bool falls = meaning.range.value.near > meaning.range.value.far;
            meaning.near = {falls ? NearLevels::bright : NearLevels::dark, meaning.range.origin};
        }
    }
    if (!states(&DepthStatement::range))
        meaning.range = {guess_range(levels, meaning), Origin::found};
}

double holes_share(const std::vector<cv::Mat>& pictures, const DepthMeaning& meaning) {
    std::size_t all = 0;
    std::size_t seen = 0;
    for (const cv::Mat& picture : pictures) {
        const Lattice lattice = lattice_of(picture);
        all += lattice.levels.size();
        seen += sorted_levels({lattice}, meaning.no_data.value).size();
    }
    if (all == 0) return 0.0;
    return static_cast<double>(all - seen) / static_cast<double>(all);
}

int levels_used(const std::vector<cv::Mat>& pictures) {
    std::set<float> used;
    for (const cv::Mat& picture : pictures) {
        cv::Mat all;
        grey_of(picture).convertTo(all, CV_32F);
        for (int j = 0; j < all.rows; ++j) {  // a row has far fewer levels than pixels
            float* const row = all.ptr<float>(j);
            float* const end = std::remove_if(row, row + all.cols,
                                              [](float level) { return !std::isfinite(level); });
            std::sort(row, end);
            used.insert(row, std::unique(row, end));
        }
    }
    return static_cast<int>(used.size());
}

}  // namespace dibhr
