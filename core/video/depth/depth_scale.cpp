// Levels of the source to levels of depth images, by table where there are few enough.
#include "core/video/depth/depth_scale.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr double kFineSteps = 65535.0;  ///< highest level if the source has no equal steps
/// A span of fewer millimetres would be taken for the steps of an 8-bit image.
constexpr double kLeastMillimetres = 256.0;
constexpr int kMostTabled = 16;
constexpr std::size_t kLevelsOfEightBits = 256;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();

double in_mm(DepthUnit unit, double distance) {
    return one_in_mm(unit) * distance;
}

/// A level of 8 bits to that of an image whose steps are the source's.
struct LevelRamp {
    float rise;  ///< 1 or -1
    float at_0, lowest, highest;

    [[nodiscard, gnu::always_inline]] float operator()(std::uint8_t level) const {
        const float sum = at_0 + rise * static_cast<float>(level);
        const float bounded = sum > lowest ? sum : lowest;
        return bounded < highest ? bounded : highest;
    }
};

std::uint32_t bits_of(float number) {
    return std::bit_cast<std::uint32_t>(number);
}

/// The sums that give the table's very bits; nothing: there are none.
std::optional<LevelRamp> ramp_of(const std::vector<float>& of_level) {
    const auto [lowest, highest] = std::minmax_element(of_level.begin(), of_level.end());
    for (std::size_t k = 1; k < of_level.size(); ++k) {
        const float rise = of_level[k] - of_level[k - 1];
        if (std::fabs(rise) != 1.0F) continue;
        const LevelRamp ramp{rise, of_level[k] - rise * static_cast<float>(k), *lowest, *highest};
        std::uint8_t level = 0;
        const bool same = std::all_of(of_level.begin(), of_level.end(), [&](float of_table) {
            return bits_of(ramp(level++)) == bits_of(of_table);
        });
        return same ? std::optional(ramp) : std::nullopt;
    }
    return std::nullopt;
}

/// `of_level` has an entry for every level of these bits.
template <typename Level>
void map_levels(const cv::Mat& grey, const std::vector<float>& of_level, std::vector<float>& out) {
    std::size_t k = 0;
    const std::size_t last = of_level.size() - 1;
    for (int j = 0; j < grey.rows; ++j) {
        const Level* row = grey.ptr<Level>(j);
        for (int i = 0; i < grey.cols; ++i)
            out[k++] = of_level[std::min<std::size_t>(row[i], last)];
    }
}

/// Pixels from 8 bits by a table of 256.
DIBHR_VECTOR_CLONES void map_table(const std::uint8_t* __restrict row,
                                   const float* __restrict table, std::size_t count,
                                   float* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = table[row[i]];
}

/// Pixels from 8 bits by sums instead of a table, many at a time.
DIBHR_VECTOR_CLONES void map_ramp(const std::uint8_t* __restrict row, const LevelRamp& of,
                                  std::size_t count, float* __restrict out) {
    const LevelRamp ramp = of;
    for (std::size_t i = 0; i < count; ++i) out[i] = ramp(row[i]);
}

/// The mapping of a number to its level, where it is linear between two bounds.
struct Linear {
    double scale, far, per_one, highest, lowest_of, highest_of;
};

DIBHR_VECTOR_CLONES void map_numbers(const float* numbers, const Linear& linear, int count,
                                     float* __restrict out) {
    const auto [scale, far, per_one, highest, lowest_of, highest_of] = linear;
    for (int i = 0; i < count; ++i) {
        const double nearness = (static_cast<double>(numbers[i]) * scale - far) * per_one;
        const double bounded = std::min(std::max(nearness, lowest_of), highest_of);
        const bool finite = std::fabs(numbers[i]) <= std::numeric_limits<float>::max();
        out[i] = finite ? static_cast<float>(highest * bounded) : kNoData;
    }
}

/// `of_level` has 256 entries.
void map_bytes(const cv::Mat& grey, const std::vector<float>& of_level, DepthImage& depth) {
    const std::optional<LevelRamp> ramp = ramp_of(of_level);
    const auto count = static_cast<std::size_t>(grey.cols);
    for (int j = 0; j < grey.rows; ++j) {
        const auto* const row = grey.ptr<std::uint8_t>(j);
        float* const out = depth.levels.data() + depth.index(0, j);
        if (ramp)
            map_ramp(row, *ramp, count, out);
        else
            map_table(row, of_level.data(), count, out);
    }
}

}  // namespace

double highest_level_of(const DepthMeaning& meaning, int bits) {
    const DepthRange& range = meaning.range.value;
    if (meaning.unit.value == DepthUnit::levels && bits != kRealBits)
        return std::fabs(range.near - range.far) / meaning.scale.value;
    const double span_mm = in_mm(meaning.unit.value, std::fabs(range.far - range.near));
    return meaning.is_metric() && span_mm >= kLeastMillimetres ? span_mm : kFineSteps;
}

DepthScale::DepthScale(const DepthMeaning& meaning, int bits)
    : meaning_(meaning),
      highest_(highest_level_of(meaning, bits)),
      always_data_(meaning.unit.value == DepthUnit::levels && meaning.no_data.value.empty() &&
                   bits != kRealBits) {
    const DepthRange& range = meaning_.range.value;
    far_ = linear_value(meaning_.unit.value, range.far);
    per_one_ = 1.0 / (linear_value(meaning_.unit.value, range.near) - far_);
    if (bits > kMostTabled) return;
    of_level_.resize(std::size_t{1} << bits);
    for (std::size_t level = 0; level < of_level_.size(); ++level)
        of_level_[level] = (*this)(static_cast<double>(level));
}

DepthScale DepthScale::as_recorded(int bits) {
    DepthMeaning meaning;
    meaning.range.value = {bits == kRealBits ? dibhr::highest_level(8) : dibhr::highest_level(bits),
                           0.0};
    DepthScale scale(meaning, bits);
    scale.highest_ = meaning.range.value.near;
    scale.as_recorded_ = true;
    return scale;
}

bool DepthScale::is_no_data(double level) const {
    if (!std::isfinite(level)) return true;
    const std::vector<double>& none = meaning_.no_data.value;
    return std::find(none.begin(), none.end(), level) != none.end();
}

float DepthScale::operator()(double level) const {
    if (is_no_data(level)) return std::nanf("");
    const double value = level * meaning_.scale.value;
    const bool of_infinity = meaning_.unit.value == DepthUnit::disparity && !(value > 0.0);
    if (of_infinity) return 0.0F;
    const double nearness = (linear_value(meaning_.unit.value, value) - far_) * per_one_;
    return static_cast<float>(highest_ *
                              (as_recorded_ ? nearness : std::clamp(nearness, 0.0, 1.0)));
}

DepthImage DepthScale::image_of(const cv::Mat& picture, DepthImage used,
                                const std::vector<float>* level_of_code) const {
    const cv::Mat grey = level_of_code != nullptr ? picture : grey_of(picture);
    DepthImage depth{grey.cols, grey.rows, highest_, std::move(used.levels)};
    depth.levels.resize(grey.total());
    const auto out_of = [&depth](int row) { return depth.levels.data() + depth.index(0, row); };
    if (level_of_code != nullptr) {
        std::vector<float> of_code(level_of_code->size());
        map_row(level_of_code->data(), static_cast<int>(of_code.size()), of_code.data());
        map_bytes(grey, of_code, depth);
    } else if (grey.depth() == CV_8U && of_level_.size() == kLevelsOfEightBits) {
        map_bytes(grey, of_level_, depth);
    } else if (grey.depth() == CV_8U && !of_level_.empty()) {
        map_levels<std::uint8_t>(grey, of_level_, depth.levels);
    } else if (grey.depth() == CV_16U && !of_level_.empty()) {
        map_levels<std::uint16_t>(grey, of_level_, depth.levels);
    } else {
        cv::Mat numbers = grey;
        if (grey.type() != CV_32FC1) grey.convertTo(numbers, CV_32F);
        for (int j = 0; j < grey.rows; ++j) map_row(numbers.ptr<float>(j), grey.cols, out_of(j));
    }
    return depth;
}

/// Gives the same as operator() for each number, many at a time where possible.
void DepthScale::map_row(const float* numbers, int count, float* out) const {
    if (meaning_.unit.value == DepthUnit::disparity) {
        for (int i = 0; i < count; ++i) out[i] = (*this)(numbers[i]);
        return;
    }
    const Linear linear{
        meaning_.scale.value,           far_, per_one_, highest_, as_recorded_ ? -kUnbounded : 0.0,
        as_recorded_ ? kUnbounded : 1.0};
    map_numbers(numbers, linear, count, out);
    for (const double none : meaning_.no_data.value)
        for (int i = 0; i < count; ++i)
            out[i] = static_cast<double>(numbers[i]) == none ? kNoData : out[i];
}

cv::Mat DepthScale::distances_mm(const cv::Mat& picture) const {
    cv::Mat distances;
    grey_of(picture).convertTo(distances, CV_32F);
    const double one_mm = in_mm(meaning_.unit.value, meaning_.scale.value);
    for (int j = 0; j < distances.rows; ++j) {
        float* const row = distances.ptr<float>(j);
        for (int i = 0; i < distances.cols; ++i)
            row[i] = row[i] > 0.0F && !is_no_data(row[i]) ? static_cast<float>(one_mm * row[i])
                                                          : std::nanf("");
    }
    return distances;
}

}  // namespace dibhr
