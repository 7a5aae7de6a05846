// Puts bytes together, and compares the second differences of numbers with those of their bytes.
#include "core/video/depth/byte_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

// Channels of OpenCV's pictures.
constexpr std::size_t kBlueByte = 0;
constexpr std::size_t kGreenByte = 1;
constexpr std::size_t kRedByte = 2;
constexpr std::size_t kAlphaByte = 3;

/// Channels of a number's bytes, the highest byte first.
using ByteOrder = std::span<const std::size_t>;

ByteOrder byte_order(DepthCode code) noexcept {
    static constexpr std::array kBlueHighest{kAlphaByte, kBlueByte, kGreenByte, kRedByte};
    static constexpr std::array kRedHighest{kAlphaByte, kRedByte, kGreenByte, kBlueByte};
    switch (code) {
        case DepthCode::rg16:
            return ByteOrder(kRedHighest).subspan(1, 2);
        case DepthCode::gb16:
            return ByteOrder(kRedHighest).subspan(2);
        case DepthCode::rgb24:
            return ByteOrder(kBlueHighest).subspan(1);
        case DepthCode::bgr24:
        case DepthCode::terrain:
            return ByteOrder(kRedHighest).subspan(1);
        case DepthCode::float32:
            return kBlueHighest;
        case DepthCode::float32_bgra:
            return kRedHighest;
        default:
            break;
    }
    return {};
}

std::uint32_t number_at(const std::uint8_t* pixel, ByteOrder order) {
    std::uint32_t number = 0;
    for (const std::size_t channel : order) number = number << 8U | pixel[channel];
    return number;
}

bool is_float(DepthCode code) noexcept {
    return byte_order(code).size() == sizeof(float);
}

/// Of the codes whose numbers are real.
float real_number(std::uint32_t number, DepthCode code) {
    if (is_float(code)) return std::bit_cast<float>(number);
    if (code == DepthCode::terrain) return static_cast<float>(-10000.0 + 0.1 * number);
    return static_cast<float>(number);  // 24 bits: exact
}

bool has_bytes(const cv::Mat& picture, DepthCode code) {
    return picture.depth() == CV_8U && picture.channels() <= 4 &&
           picture.channels() >= least_channels(code);
}

// Finding out.

constexpr std::size_t kSampledPixels = 40000;  ///< about as many of each picture are looked at
constexpr std::int64_t kLeastSteps = 64;
/// Least share of steps of a true code that vanish; of noise two in nine do.
constexpr double kLeastContinued = 0.7;
/// The same of those that vanish almost wholly: of a smooth surface between many small edges two in
/// five; of noise one in forty, of 400 coloured pictures one in seven at most, of floats in a wrong
/// order one in four.
constexpr double kLeastSmooth = 0.33;

/// Calls `visit` with the first pixel of every few rows that have rows beside them.
template <typename Visit>
void visit_rows(const cv::Mat& picture, const Visit& visit) {
    const int every = static_cast<int>(std::max<std::size_t>(1, picture.total() / kSampledPixels));
    for (int j = 1 + (every - 1) / 2; j + 1 < picture.rows; j += every)
        visit(picture.ptr<std::uint8_t>(j));
}

/// Places where the second difference of a number without its lowest byte is one, and how many of
/// them have a small one with that byte, or a very small one.
struct Steps {
    std::int64_t all{0};
    std::int64_t continued{0};
    std::int64_t smooth{0};

    void add(std::int64_t before, std::int64_t here, std::int64_t after) {
        constexpr std::int64_t kSmall = 128;                 // half of a step
        constexpr std::int64_t kVerySmall = 16;              // a sixteenth
        constexpr std::int64_t kSlow = 4;                    // of a surface, where two are equal
        if (before == 0 || here == 0 || after == 0) return;  // no data
        // Flat colours that meet, as in a drawing, tell nothing.
        const bool may_be_flat = before == here || here == after;
        if (may_be_flat && std::abs(after - before) > kSlow) return;
        if (std::abs((before >> 8) - 2 * (here >> 8) + (after >> 8)) != 1) return;
        ++all;
        const std::int64_t second = std::abs(before - 2 * here + after);
        continued += static_cast<std::int64_t>(second < kSmall);
        smooth += static_cast<std::int64_t>(second < kVerySmall);
    }

    Steps& operator+=(const Steps& others) {
        all += others.all;
        continued += others.continued;
        smooth += others.smooth;
        return *this;
    }

    [[nodiscard]] bool vanish() const {
        const auto steps = static_cast<double>(all);
        return static_cast<double>(continued) >= kLeastContinued * steps ||
               static_cast<double>(smooth) >= kLeastSmooth * steps;
    }
};

/// Of the numbers of a code's two highest bytes, its three highest, and so on.
using StepsOfBytes = std::array<Steps, 3>;

void add(StepsOfBytes& sum, const StepsOfBytes& steps) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += steps[k];
}

/// Adds the steps of one row, along it and across it. `rows`: the numbers above, in and below it.
void add_steps(StepsOfBytes& steps, std::size_t bytes,
               const std::array<std::vector<std::uint32_t>, 3>& rows) {
    const auto& [above, row, below] = rows;
    for (std::size_t of = 2; of <= bytes; ++of) {
        Steps& sum = steps[of - 2];
        const auto number = [shift = 8U * (bytes - of)](std::uint32_t all_bytes) {
            return static_cast<std::int64_t>(all_bytes >> shift);
        };
        for (std::size_t i = 1; i + 1 < row.size(); ++i) {
            const std::int64_t here = number(row[i]);
            sum.add(number(row[i - 1]), here, number(row[i + 1]));
            sum.add(number(above[i]), here, number(below[i]));
        }
    }
}

StepsOfBytes steps_in(const cv::Mat& picture, ByteOrder order) {
    StepsOfBytes steps;
    const auto down = static_cast<std::ptrdiff_t>(picture.step[0]);
    std::array<std::vector<std::uint32_t>, 3> rows;
    for (std::vector<std::uint32_t>& row : rows) row.resize(static_cast<std::size_t>(picture.cols));
    visit_rows(picture, [&](const std::uint8_t* middle) {
        const std::uint8_t* pixel = middle - down;
        for (std::vector<std::uint32_t>& row : rows) {
            const std::uint8_t* from = std::exchange(pixel, pixel + down);
            for (std::uint32_t& number : row) {
                number = number_at(from, order);
                from += picture.channels();
            }
        }
        add_steps(steps, order.size(), rows);
    });
    return steps;
}

/// As is_continuous(). The highest byte of a shallow scene is the same everywhere, or steps at
/// silhouettes alone, and the lowest one may be noise: so one pair of bytes is enough.
std::optional<bool> do_vanish(const StepsOfBytes& steps) {
    bool has_steps = false;
    for (const Steps& one : steps) {
        if (one.all < kLeastSteps) continue;
        has_steps = true;
        if (one.vanish()) return true;
    }
    return has_steps ? std::optional(false) : std::nullopt;
}

bool all_have_bytes(std::span<const cv::Mat> pictures, DepthCode code) {
    return std::all_of(pictures.begin(), pictures.end(),
                       [code](const cv::Mat& one) { return has_bytes(one, code); });
}

/// Whether the steps of all pictures vanish and none of them contradicts alone: the first one tells
/// of most codes that the colours are none.
bool each_is_continuous(std::span<const cv::Mat> pictures, DepthCode code) {
    if (!all_have_bytes(pictures, code)) return false;
    StepsOfBytes all;
    for (const cv::Mat& picture : pictures) {
        const StepsOfBytes steps = steps_in(picture, byte_order(code));
        if (!do_vanish(steps).value_or(true)) return false;
        add(all, steps);
    }
    return do_vanish(all).value_or(false);
}

/// The share of pixels with data for which `fits` is true.
template <typename Fits>
double share_where(std::span<const cv::Mat> pictures, ByteOrder order, const Fits& fits) {
    std::int64_t all = 0;
    std::int64_t fitting = 0;
    for (const cv::Mat& picture : pictures) {
        visit_rows(picture, [&](const std::uint8_t* row) {
            for (int i = 0; i < picture.cols; ++i) {
                const std::uint8_t* const pixel =
                    row + i * static_cast<std::ptrdiff_t>(picture.channels());
                if (number_at(pixel, order) == 0) continue;
                ++all;
                fitting += static_cast<std::int64_t>(fits(pixel));
            }
        });
    }
    return all > 0 ? static_cast<double>(fitting) / static_cast<double>(all) : 0.0;
}

constexpr double kNearlyAll = 0.98;

/// Whether blue is one of two values nearly everywhere: it is not used, or marks something.
bool is_blue_unused(std::span<const cv::Mat> pictures, ByteOrder order) {
    std::array<std::int64_t, 256> counts{};
    (void)share_where(pictures, order, [&counts](const std::uint8_t* pixel) {
        ++counts[pixel[kBlueByte]];
        return true;
    });
    std::int64_t all = 0;
    for (const std::int64_t count : counts) all += count;
    std::partial_sort(counts.begin(), counts.begin() + 2, counts.end(), std::greater<>{});
    return static_cast<double>(counts[0] + counts[1]) >= kNearlyAll * static_cast<double>(all);
}

/// The mean difference of neighbours with data, of the whole span of the numbers: of a surface in
/// the right order about a hundredth, else up to a third.
double roughness(std::span<const cv::Mat> pictures, ByteOrder order) {
    double sum = 0.0;
    double count = 0.0;
    std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
    std::int64_t highest = 0;
    for (const cv::Mat& picture : pictures) {
        const auto right = static_cast<std::ptrdiff_t>(picture.channels());
        visit_rows(picture, [&](const std::uint8_t* pixel) {
            std::int64_t before = 0;
            for (int i = 0; i < picture.cols; ++i, pixel += right) {
                const auto here = static_cast<std::int64_t>(number_at(pixel, order));
                if (here != 0) {
                    lowest = std::min(lowest, here);
                    highest = std::max(highest, here);
                }
                if (here != 0 && before != 0) {
                    sum += static_cast<double>(std::abs(here - before));
                    count += 1.0;
                }
                before = here;
            }
        });
    }
    const bool is_flat = highest <= lowest;
    return count > 0.0 && !is_flat ? sum / count / static_cast<double>(highest - lowest) : 0.0;
}

/// Whether numbers of this code are those of scenes: heights on the earth, floats of usual size.
bool is_plausible(std::span<const cv::Mat> pictures, DepthCode code) {
    const ByteOrder order = byte_order(code);
    if (code == DepthCode::rg16) return is_blue_unused(pictures, order);
    if (code == DepthCode::gb16) {  // else red is a higher byte, as of heights
        const auto lacks_red = [](const std::uint8_t* pixel) { return pixel[kRedByte] == 0; };
        return share_where(pictures, order, lacks_red) >= kNearlyAll;
    }
    if (code == DepthCode::terrain) {  // from 3446 m below the sea to 9661 m
        const auto is_height = [](const std::uint8_t* pixel) {
            return pixel[kRedByte] == 1 || pixel[kRedByte] == 2;
        };
        return share_where(pictures, order, is_height) >= kNearlyAll &&
               !is_blue_unused(pictures, order);
    }
    if (is_float(code)) {
        constexpr float kLeast = 1e-4F;
        constexpr float kMost = 1e6F;
        constexpr double kLeastFinite = 0.05;
        const auto number = [order, code](const std::uint8_t* pixel) {
            return real_number(number_at(pixel, order), code);
        };
        const double finite = share_where(pictures, order, [&number](const std::uint8_t* pixel) {
            return std::isfinite(number(pixel));
        });
        const double usual = share_where(pictures, order, [&number](const std::uint8_t* pixel) {
            return number(pixel) >= kLeast && number(pixel) <= kMost;
        });
        return finite >= kLeastFinite && usual >= kNearlyAll * finite;
    }
    return true;
}

/// The one of two codes of contrary orders that is clearly smoother; nothing: neither is.
std::optional<DepthCode> smoother(std::span<const cv::Mat> pictures, DepthCode one,
                                  DepthCode other) {
    constexpr double kClearly = 3.0;
    const double of_one = roughness(pictures, byte_order(one));
    const double of_other = roughness(pictures, byte_order(other));
    if (kClearly * of_one < of_other) return one;
    return kClearly * of_other < of_one ? std::optional(other) : std::nullopt;
}

}  // namespace

bool is_of_bytes(DepthCode code) noexcept {
    return !byte_order(code).empty();
}

int least_channels(DepthCode code) noexcept {
    return is_float(code) ? 4 : 3;
}

int bits_in_bytes(DepthCode code) noexcept {
    return byte_order(code).size() == sizeof(std::uint16_t) ? 16 : kRealBits;
}

bool have_contrary_bytes(DepthCode one, DepthCode other) noexcept {
    const ByteOrder first = byte_order(one);
    const ByteOrder second = byte_order(other);
    for (std::size_t k = 1; k < first.size(); ++k) {
        const auto higher = std::find(second.begin(), second.end(), first[k - 1]);
        const auto lower = std::find(second.begin(), second.end(), first[k]);
        if (higher != second.end() && lower != second.end() && lower < higher) return true;
    }
    return false;
}

cv::Mat numbers_in_bytes(const cv::Mat& picture, DepthCode code) {
    const bool is_whole = bits_in_bytes(code) != kRealBits;
    cv::Mat numbers(picture.rows, picture.cols, is_whole ? CV_16UC1 : CV_32FC1,
                    cv::Scalar(is_whole ? 0.0 : std::numeric_limits<double>::quiet_NaN()));
    if (!has_bytes(picture, code)) return numbers;
    const ByteOrder order = byte_order(code);
    for (int j = 0; j < picture.rows; ++j) {
        const std::uint8_t* pixel = picture.ptr<std::uint8_t>(j);
        for (int i = 0; i < picture.cols; ++i, pixel += picture.channels()) {
            const std::uint32_t number = number_at(pixel, order);
            if (is_whole)
                numbers.at<std::uint16_t>(j, i) = static_cast<std::uint16_t>(number);
            else
                numbers.at<float>(j, i) = real_number(number, code);
        }
    }
    return numbers;
}

DepthStatement byte_code_meaning(DepthCode code) {
    constexpr double kHighestOf24Bits = 16777215.0;
    DepthStatement meaning;
    meaning.code = code;
    if (code == DepthCode::rgb24 || code == DepthCode::bgr24) {
        if (code == DepthCode::rgb24) meaning.near = NearLevels::dark;
        meaning.unit = DepthUnit::levels;
        meaning.no_data = std::vector{0.0, kHighestOf24Bits};  // the sky is the farthest
    } else if (code == DepthCode::terrain) {
        meaning.near = NearLevels::bright;
        meaning.unit = DepthUnit::levels;
        meaning.no_data = std::vector{-10000.0};
    }
    return meaning;
}

std::optional<bool> is_continuous(std::span<const cv::Mat> pictures, DepthCode code) {
    if (!all_have_bytes(pictures, code)) return std::nullopt;
    StepsOfBytes all;
    for (const cv::Mat& picture : pictures) add(all, steps_in(picture, byte_order(code)));
    return do_vanish(all);
}

std::optional<DepthCode> byte_code_in(std::span<const cv::Mat> pictures) {
    // Of codes that agree in the order of their bytes the first: it has them all, or no others.
    std::optional<DepthCode> found;
    for (const DepthCode code :
         {DepthCode::float32, DepthCode::float32_bgra, DepthCode::terrain, DepthCode::rg16,
          DepthCode::gb16, DepthCode::rgb24, DepthCode::bgr24}) {
        if (!each_is_continuous(pictures, code) || !is_plausible(pictures, code)) continue;
        if (!found)
            found = code;
        else if (have_contrary_bytes(*found, code))
            found = smoother(pictures, *found, code);
        if (!found) break;
    }
    return found;
}

}  // namespace dibhr
