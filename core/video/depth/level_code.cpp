// Turns and parts bits, divides by disparities, and compares points with the rays of a camera.
#include "core/video/depth/level_code.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>
#include <set>

namespace dibhr {

namespace {

constexpr int kKinectNone = 2047;
constexpr int kDistanceBits = 0x1fff;  ///< of depth16; a confidence is above
constexpr std::size_t kPointsZ = 0;    ///< channels of OpenCV's pictures are the last one first
constexpr std::size_t kPointsY = 1;
constexpr std::size_t kPointsX = 2;

int turned(int level) {
    return (level >> 3 | level << 13) & 0xffff;
}

/// Levels of 16 bits, with the bytes in the order in which 11 bits are enough.
cv::Mat in_11_bits(const cv::Mat& picture) {
    double highest = 0.0;
    cv::minMaxLoc(picture, nullptr, &highest);
    if (highest <= kKinectNone) return picture;
    cv::Mat swapped(picture.size(), CV_16UC1);
    for (int j = 0; j < picture.rows; ++j)
        for (int i = 0; i < picture.cols; ++i) {
            const int level = picture.at<std::uint16_t>(j, i);
            swapped.at<std::uint16_t>(j, i) =
                static_cast<std::uint16_t>((level >> 8 | level << 8) & 0xffff);
        }
    return swapped;
}

float distance_of(double level, const InverseLevels& law) {
    const double distance_mm = law.factor_mm / (level + law.offset);
    return level > 0.0 && std::isfinite(level) && distance_mm > 0.0 && std::isfinite(distance_mm)
               ? static_cast<float>(distance_mm)
               : std::numeric_limits<float>::quiet_NaN();
}

/// The numbers of a picture of one channel, each by `of`.
template <typename Number>
cv::Mat each_level(const cv::Mat& picture, int type, const Number& of) {
    cv::Mat levels;
    picture.convertTo(levels, CV_32F);
    cv::Mat numbers(picture.size(), type);
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i) of(levels.at<float>(j, i), numbers, j, i);
    return numbers;
}

cv::Mat turned_back(const cv::Mat& picture) {
    return each_level(picture, CV_16UC1, [](float level, cv::Mat& numbers, int j, int i) {
        numbers.at<std::uint16_t>(j, i) =
            static_cast<std::uint16_t>(turned(static_cast<int>(level)));
    });
}

cv::Mat distances_mm(const cv::Mat& picture, const InverseLevels& law) {
    return each_level(picture, CV_32FC1, [&law](float level, cv::Mat& numbers, int j, int i) {
        numbers.at<float>(j, i) = distance_of(static_cast<double>(level), law);
    });
}

cv::Mat without_none(cv::Mat distances) {
    distances.setTo(std::numeric_limits<double>::quiet_NaN(), ~(distances > 0.0));
    return distances;
}

/// The correlation of pairs of numbers.
class Pairs {
  public:
    void add(double x, double y) {
        sums_ += cv::Vec<double, 5>(x, y, x * x, y * y, x * y);
        count_ += 1.0;
    }
    [[nodiscard]] double correlation() const {
        const double of_x = count_ * sums_[2] - sums_[0] * sums_[0];
        const double of_y = count_ * sums_[3] - sums_[1] * sums_[1];
        const double both = count_ * sums_[4] - sums_[0] * sums_[1];
        return of_x > 0.0 && of_y > 0.0 ? both / std::sqrt(of_x * of_y) : 0.0;
    }
    [[nodiscard]] double count() const { return count_; }

  private:
    cv::Vec<double, 5> sums_{};
    double count_{0.0};
};

/// Whether x / z rises evenly along the columns, and y / z along the rows.
bool is_of_points(const cv::Mat& picture) {
    constexpr int kPointsAlong = 64;
    constexpr double kLeastPoints = 100.0;
    constexpr double kLeastCorrelation = 0.99;  // a lens may bend them a little
    Pairs columns;
    Pairs rows;
    for (int j = 0; j < kPointsAlong; ++j)
        for (int i = 0; i < kPointsAlong; ++i) {
            const int row = (2 * j + 1) * picture.rows / (2 * kPointsAlong);
            const int column = (2 * i + 1) * picture.cols / (2 * kPointsAlong);
            const auto& point = picture.at<cv::Vec3f>(row, column);
            const auto z = static_cast<double>(point[kPointsZ]);
            const double right = static_cast<double>(point[kPointsX]) / z;
            const double down = static_cast<double>(point[kPointsY]) / z;
            if (!(z > 0.0) || !std::isfinite(right) || !std::isfinite(down)) continue;
            columns.add(column, right);
            rows.add(row, down);
        }
    return columns.count() >= kLeastPoints &&
           std::abs(columns.correlation()) >= kLeastCorrelation &&
           std::abs(rows.correlation()) >= kLeastCorrelation;
}

/// Levels of pictures, as many as fulfil something.
template <typename Fits>
double count_levels(std::span<const cv::Mat> pictures, const Fits& fits) {
    std::size_t count = 0;
    for (const cv::Mat& picture : pictures)
        for (int j = 0; j < picture.rows; ++j) {
            const auto* const row = picture.ptr<std::uint16_t>(j);
            count += static_cast<std::size_t>(std::count_if(row, row + picture.cols, fits));
        }
    return static_cast<double>(count);
}

bool is_of_room(std::span<const cv::Mat> pictures) {
    constexpr double kMostOfLevels = 0.95;
    constexpr int kFarthest_mm = 16384;  // other levels are beyond, but for a quarter
    const double all = count_levels(pictures, [](int level) { return level != 0; });
    const double near = count_levels(
        pictures, [](int level) { return level != 0 && turned(level) < kFarthest_mm; });
    return near >= kMostOfLevels * all;
}

/// Pixels of a lattice over a picture of 16 bits.
cv::Mat few_levels_of(const cv::Mat& picture) {
    constexpr double kMostLevels = 40000.0;
    const int step = std::max(
        1, static_cast<int>(std::sqrt(static_cast<double>(picture.total()) / kMostLevels)));
    cv::Mat few((picture.rows + step - 1) / step, (picture.cols + step - 1) / step, CV_16UC1);
    for (int j = 0; j < few.rows; ++j)
        for (int i = 0; i < few.cols; ++i)
            few.at<std::uint16_t>(j, i) = picture.at<std::uint16_t>(j * step, i * step);
    return few;
}

/// Whether 2047 stands out from the other levels, which are of 0.42 m and more.
bool looks_like_kinect(const cv::Mat& picture) {
    constexpr double kLeastOfNone = 5e-4;  // of the pixels
    constexpr double kLeastSeen = 0.1;
    constexpr double kMostOfLevels = 0.98;
    constexpr int kNearestLevel = 300;
    constexpr int kFarthestLevel = 1092;
    const cv::Mat raw = in_11_bits(few_levels_of(picture));
    const std::span<const cv::Mat> levels(&raw, 1);
    const auto all = static_cast<double>(raw.total());
    if (count_levels(levels, [](int level) { return level > kKinectNone; }) > 0.0) return false;
    const double none = count_levels(levels, [](int level) { return level == kKinectNone; });
    const double seen = count_levels(
        levels, [](int level) { return level >= kNearestLevel && level <= kFarthestLevel; });
    return none >= kLeastOfNone * all && seen >= kLeastSeen * all &&
           seen >= kMostOfLevels * (all - none);
}

/// Whether all levels are multiples of 8, as where three bits are turned away from below, but not
/// of 16; and many differ, mostly of 256 mm and more: less is of 8 bits.
bool looks_turned(const cv::Mat& picture) {
    constexpr std::size_t kLeastDifferent = 64;
    constexpr double kMostOfLevels = 0.95;
    constexpr int kNearest_mm = 256;
    const cv::Mat raw = few_levels_of(picture);
    const std::set<int> levels(raw.begin<std::uint16_t>(), raw.end<std::uint16_t>());
    const auto are_multiples = [&levels](int of) {
        return std::all_of(levels.begin(), levels.end(),
                           [of](int level) { return level % of == 0; });
    };
    if (levels.size() < kLeastDifferent || !are_multiples(8) || are_multiples(16)) return false;
    const double all = count_levels({&raw, 1}, [](int level) { return level != 0; });
    const double far =
        count_levels({&raw, 1}, [](int level) { return turned(level) >= kNearest_mm; });
    return far >= kMostOfLevels * all;
}

/// Places of a picture where the three highest bits change from a pixel to the next one.
struct ConfidenceSteps {
    double pixels{0.0};
    double steps{0.0};
    double even{0.0};  ///< steps over which the other bits go on
};

/// Where levels are plain distances, the other bits leap there: by all of them where a surface
/// passes 8192, by any number at an outline.
ConfidenceSteps confidence_steps(const cv::Mat& picture) {
    constexpr int kEven_mm = 50;
    ConfidenceSteps found;
    found.pixels = static_cast<double>(picture.total());
    for (int j = 0; j < picture.rows; ++j) {
        const auto* const row = picture.ptr<std::uint16_t>(j);
        for (int i = 1; i < picture.cols; ++i) {
            const int here = row[i] & kDistanceBits;
            const int before = row[i - 1] & kDistanceBits;
            const bool is_step = row[i] - here != row[i - 1] - before;
            if (!is_step || here == 0 || before == 0) continue;
            found.steps += 1.0;
            if (std::abs(here - before) <= kEven_mm) found.even += 1.0;
        }
    }
    return found;
}

bool may_have_confidence(const cv::Mat& picture) {
    constexpr double kFewSteps = 8.0;
    constexpr double kMostlyEven = 0.5;
    const ConfidenceSteps found = confidence_steps(picture);
    return found.steps >= kFewSteps && found.even >= kMostlyEven * found.steps;
}

/// Whether distances go on at many places where the confidence changes, and many differ.
bool looks_confident(const cv::Mat& picture) {
    constexpr double kManySteps = 32.0;
    constexpr double kLeastOfPixels = 0.002;
    constexpr double kMostlyEven = 0.7;
    constexpr std::size_t kLeastDifferent = 16;
    const ConfidenceSteps found = confidence_steps(picture);
    if (found.steps < std::max(kManySteps, kLeastOfPixels * found.pixels) ||
        found.even < kMostlyEven * found.steps)
        return false;
    const cv::Mat distances = few_levels_of(picture) & cv::Scalar(kDistanceBits);
    return std::set<int>(distances.begin<std::uint16_t>(), distances.end<std::uint16_t>()).size() >=
           kLeastDifferent;
}

template <typename Fits>
bool all_fit(std::span<const cv::Mat> pictures, DepthCode code, const Fits& fits) {
    return !pictures.empty() &&
           std::all_of(pictures.begin(), pictures.end(), [&](const cv::Mat& picture) {
               return has_levels(picture, code) && fits(picture);
           });
}

}  // namespace

bool is_of_levels(DepthCode code) noexcept {
    return code == DepthCode::turned16 || code == DepthCode::kinect11 ||
           code == DepthCode::stereo || code == DepthCode::xyz || code == DepthCode::depth16;
}

bool has_whole_numbers(DepthCode code) noexcept {
    return code == DepthCode::turned16 || code == DepthCode::depth16;
}

bool has_levels(const cv::Mat& picture, DepthCode code) {
    if (code == DepthCode::xyz) return picture.type() == CV_32FC3;
    return picture.channels() == 1 && (code == DepthCode::stereo || picture.depth() == CV_16U);
}

cv::Mat numbers_in_levels(const cv::Mat& picture, DepthCode code, const InverseLevels& law) {
    const bool is_whole = has_whole_numbers(code);
    if (!has_levels(picture, code))
        return {picture.rows, picture.cols, is_whole ? CV_16UC1 : CV_32FC1,
                cv::Scalar(is_whole ? 0.0 : std::numeric_limits<double>::quiet_NaN())};
    if (code == DepthCode::depth16) return picture & cv::Scalar(kDistanceBits);
    if (is_whole) return turned_back(picture);
    if (code == DepthCode::xyz) {
        cv::Mat z;
        cv::extractChannel(picture, z, static_cast<int>(kPointsZ));
        return without_none(z);
    }
    if (code == DepthCode::stereo) return distances_mm(picture, law);
    const cv::Mat raw = in_11_bits(picture);
    cv::Mat distances = distances_mm(raw, law);
    distances.setTo(std::numeric_limits<double>::quiet_NaN(), raw >= kKinectNone);
    return distances;
}

DepthStatement level_code_meaning(DepthCode code) {
    DepthStatement meaning;
    meaning.code = code;
    meaning.near = NearLevels::dark;
    meaning.no_data.emplace();
    if (has_whole_numbers(code)) meaning.no_data = std::vector{0.0};
    if (code == DepthCode::xyz) return meaning;
    meaning.unit = DepthUnit::mm;
    meaning.scale = 1.0;
    return meaning;
}

bool may_be_of(std::span<const cv::Mat> pictures, DepthCode code) {
    return all_fit(pictures, code, [code](const cv::Mat& picture) {
        switch (code) {
            case DepthCode::turned16:
                return is_of_room({&picture, 1});
            case DepthCode::kinect11: {
                const cv::Mat raw = in_11_bits(picture);
                return count_levels({&raw, 1}, [](int level) { return level > kKinectNone; }) ==
                       0.0;
            }
            case DepthCode::xyz:
                return is_of_points(picture);
            case DepthCode::depth16:
                return may_have_confidence(picture);
            default:
                return true;
        }
    });
}

std::optional<DepthCode> level_code_in(std::span<const cv::Mat> pictures) {
    if (all_fit(pictures, DepthCode::kinect11, looks_like_kinect)) return DepthCode::kinect11;
    if (all_fit(pictures, DepthCode::xyz, is_of_points)) return DepthCode::xyz;
    if (all_fit(pictures, DepthCode::turned16, looks_turned)) return DepthCode::turned16;
    if (all_fit(pictures, DepthCode::depth16, looks_confident)) return DepthCode::depth16;
    return std::nullopt;
}

}  // namespace dibhr
