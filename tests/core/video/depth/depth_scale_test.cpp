// The elevation of a level, by the rule of its unit.
#include "core/video/depth/depth_scale.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/video/depth/picture_levels.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

DepthMeaning meaning_of(DepthUnit unit, DepthRange range, double scale = 1.0) {
    DepthMeaning meaning;
    meaning.unit.value = unit;
    meaning.range.value = range;
    meaning.scale.value = scale;
    meaning.near.value = range.near > range.far ? NearLevels::bright : NearLevels::dark;
    return meaning;
}

/// From 0, the farthest, to 1, the nearest.
double nearness(const DepthScale& scale, double level) {
    return static_cast<double>(scale(level)) / scale.highest_level();
}

/// A picture of one row: 0 and on to the last level.
template <typename Level>
cv::Mat all_levels() {
    cv::Mat picture(1, std::numeric_limits<Level>::max() + 1, cv::DataType<Level>::type);
    for (int i = 0; i < picture.cols; ++i) picture.at<Level>(0, i) = static_cast<Level>(i);
    return picture;
}

std::uint32_t bits_of(float number) {
    return std::bit_cast<std::uint32_t>(number);
}

}  // namespace

TEST_CASE("an image in the memory of another one has the same levels", "[scale]") {
    const DepthScale scale(meaning_of(DepthUnit::levels, {255.0, 0.0}), 8);
    const cv::Mat picture = all_levels<std::uint8_t>();
    const DepthImage image = scale.image_of(picture);
    for (const std::size_t used_levels : {0U, 7U, 256U, 1000U}) {
        DepthImage used{7, 1, 3.0, std::vector<float>(used_levels, 5.0F)};
        const float* const memory = used.levels.data();
        const DepthImage again = scale.image_of(picture, std::move(used));
        CHECK(again.levels == image.levels);
        CHECK(again.columns == image.columns);
        CHECK(again.highest_level == image.highest_level);
        CHECK((again.levels.data() == memory || used_levels < image.levels.size()));
    }
}

TEST_CASE("a picture of 8 bits has the bits of each of its levels", "[scale]") {
    const DepthRange range = GENERATE(DepthRange{255.0, 0.0}, DepthRange{251.0, 20.0},
                                      DepthRange{20.0, 251.0}, DepthRange{200.5, 20.25});
    const DepthUnit unit = GENERATE(DepthUnit::levels, DepthUnit::mm, DepthUnit::disparity);
    DepthMeaning meaning = meaning_of(unit, range, GENERATE(1.0, 0.5));
    if (GENERATE(false, true)) meaning.no_data.value = {0.0, 37.0};
    CAPTURE(name_of(unit), range.near, range.far);
    const DepthScale scale(meaning, 8);
    const DepthImage image = scale.image_of(all_levels<std::uint8_t>());
    for (int level = 0; level < image.columns; ++level)
        CHECK(bits_of(image.at(level, 0)) == bits_of(scale(level)));
}

TEST_CASE("only integer levels that all mean something can have no holes", "[scale]") {
    const DepthRange bright{255.0, 0.0};
    DepthMeaning levels = meaning_of(DepthUnit::levels, bright);
    CHECK(DepthScale(levels, 8).is_always_data());
    CHECK(DepthScale::as_recorded(16).is_always_data());
    CHECK_FALSE(DepthScale(levels, kRealBits).is_always_data());
    CHECK_FALSE(DepthScale::as_recorded(kRealBits).is_always_data());
    CHECK_FALSE(DepthScale(meaning_of(DepthUnit::mm, {400.0, 4000.0}), 16).is_always_data());
    CHECK_FALSE(DepthScale(meaning_of(DepthUnit::disparity, bright), 8).is_always_data());
    levels.no_data.value = {0.0};
    CHECK_FALSE(DepthScale(levels, 8).is_always_data());
}

TEST_CASE("a level stands where the rule of its unit puts it", "[scale]") {
    struct Case {
        DepthUnit unit;
        DepthRange range;
        double scale;
        double level;
        double nearness;
    };
    const Case a = GENERATE(
        // (v - far) / (near - far)
        Case{DepthUnit::levels, {200.0, 100.0}, 1.0, 125.0, 0.25},
        Case{DepthUnit::levels, {100.0, 200.0}, 1.0, 125.0, 0.75},
        Case{DepthUnit::levels, {20.0, 10.0}, 0.1, 125.0, 0.25},
        // (far - v) / (far - near)
        Case{DepthUnit::mm, {500.0, 4500.0}, 1.0, 1500.0, 0.75},
        Case{DepthUnit::mm, {500.0, 4500.0}, 0.2, 7500.0, 0.75},
        Case{DepthUnit::m, {0.5, 4.5}, 0.0002, 7500.0, 0.75},
        Case{DepthUnit::m, {4.5, 0.5}, 1.0, 1.5, 0.25},  // near is bright
        // (1/far - 1/v) / (1/far - 1/near)
        Case{DepthUnit::disparity, {100.0, 20.0}, 1.0, 50.0, (0.05 - 0.02) / (0.05 - 0.01)},
        Case{DepthUnit::disparity, {10.0, 2.0}, 0.1, 50.0, (0.5 - 0.2) / (0.5 - 0.1)},
        Case{DepthUnit::disparity, {20.0, 100.0}, 1.0, 50.0, (0.02 - 0.01) / (0.05 - 0.01)});
    CAPTURE(name_of(a.unit), a.range.near, a.range.far, a.scale, a.level);
    for (const int bits : {16, kRealBits}) {
        const DepthScale scale(meaning_of(a.unit, a.range, a.scale), bits);
        CHECK(std::abs(nearness(scale, a.level) - a.nearness) < 1e-6);
        CHECK(std::abs(nearness(scale, a.range.near / a.scale) - 1.0) < 1e-6);
        CHECK(std::abs(nearness(scale, a.range.far / a.scale)) < 1e-6);
    }
}

TEST_CASE("what lies beyond an end of the range stands at that end", "[scale]") {
    const auto unit =
        GENERATE(DepthUnit::levels, DepthUnit::disparity, DepthUnit::mm, DepthUnit::m);
    const bool bright = GENERATE(true, false);
    CAPTURE(name_of(unit), bright);
    const DepthRange range = bright ? DepthRange{300.0, 100.0} : DepthRange{100.0, 300.0};
    for (const int bits : {16, kRealBits}) {
        const DepthScale scale(meaning_of(unit, range), bits);
        CHECK(nearness(scale, 10.0) == (bright ? 0.0 : 1.0));
        CHECK(nearness(scale, 60000.0) == (bright ? 1.0 : 0.0));
    }
}

TEST_CASE("a disparity of 0 is at infinity, and none below it is nearer", "[scale]") {
    const DepthScale scale(meaning_of(DepthUnit::disparity, {50.0, 2.0}), kRealBits);
    for (const double level : {0.0, -0.0, -1e-300, -5.0}) CHECK(scale(level) == 0.0F);
}

TEST_CASE("levels that are no data, and what is not finite, are NaN", "[scale]") {
    DepthMeaning meaning = meaning_of(DepthUnit::mm, {500.0, 4500.0});
    meaning.no_data.value = {0.0, 2047.0, 65535.0};
    for (const int bits : {16, kRealBits}) {
        const DepthScale scale(meaning, bits);
        for (const double level : {0.0, 2047.0, 65535.0}) CHECK(std::isnan(scale(level)));
        for (const double level : {1.0, 2046.0, 2048.0, 65534.0})
            CHECK(std::isfinite(scale(level)));
        const double infinity = std::numeric_limits<double>::infinity();
        for (const double level : {infinity, -infinity, std::nan("")})
            CHECK(std::isnan(scale(level)));
    }
}

TEST_CASE("a line says what depth means, and which levels mean nothing one by one", "[scale]") {
    DepthMeaning meaning = meaning_of(DepthUnit::mm, {480.0, 4210.0});
    CHECK(in_words(meaning).starts_with("distance 480 to 4210 mm, near is "));
    meaning.range.value = {0.42, 65535.0};
    CHECK(in_words(meaning).starts_with("distance 0.42 to 65535 mm, "));
    meaning.no_data.value = {0.0, 65535.0};
    CHECK(in_words(meaning).ends_with(", no data is 0 and 65535"));
    meaning.no_data.value = {0.0, 2047.0, 65535.0};
    CHECK(in_words(meaning).ends_with(", no data is 0, 2047 and 65535"));
}

TEST_CASE("a step of integer levels is a step of 1, and a millimetre one where there are enough",
          "[scale]") {
    CHECK(DepthScale(meaning_of(DepthUnit::levels, {200.0, 100.0}), 8).highest_level() == 100.0);
    CHECK(DepthScale(meaning_of(DepthUnit::levels, {1.0, 0.0}, 1.0 / 4095), 12).highest_level() ==
          4095.0);
    CHECK(DepthScale(meaning_of(DepthUnit::mm, {500.0, 4500.0}), 16).highest_level() == 4000.0);
    CHECK(DepthScale(meaning_of(DepthUnit::m, {0.5, 4.5}), kRealBits).highest_level() == 4000.0);
    CHECK(DepthScale(meaning_of(DepthUnit::mm, {500.0, 600.0}), 16).highest_level() == 65535.0);
    CHECK(DepthScale(meaning_of(DepthUnit::levels, {1.0, 0.0}), kRealBits).highest_level() ==
          65535.0);
}

TEST_CASE("tables of 8 and 16 bits say what the rule says", "[scale]") {
    const auto unit =
        GENERATE(DepthUnit::levels, DepthUnit::disparity, DepthUnit::mm, DepthUnit::m);
    DepthMeaning meaning = meaning_of(unit, {200.0, 20.0});
    meaning.no_data.value = {0.0, 77.0};
    CAPTURE(name_of(unit));
    const auto differing = [&](const cv::Mat& picture, int bits) {
        const DepthScale scale(meaning, bits);
        const DepthImage depth = scale.image_of(picture);
        cv::Mat real;
        picture.convertTo(real, CV_32F);
        const DepthImage of_real = scale.image_of(real);
        int count = 0;
        for (std::size_t k = 0; k < depth.levels.size(); ++k) {
            const float by_rule = scale(static_cast<double>(k));
            count += static_cast<int>(bits_of(depth.levels[k]) != bits_of(by_rule) ||
                                      bits_of(of_real.levels[k]) != bits_of(by_rule));
        }
        return count;
    };
    CHECK(differing(all_levels<std::uint8_t>(), 8) == 0);
    CHECK(differing(all_levels<std::uint16_t>(), 16) == 0);
}

TEST_CASE("levels as recorded are those of the file, bit for bit", "[scale]") {
    const auto differing = [](const cv::Mat& picture, int bits) {
        const DepthScale scale = DepthScale::as_recorded(bits);
        CHECK(scale.highest_level() == highest_level(bits));
        CHECK_FALSE(scale.meaning());
        const DepthImage depth = scale.image_of(picture);
        int count = 0;
        for (std::size_t k = 0; k < depth.levels.size(); ++k)
            count += static_cast<int>(bits_of(depth.levels[k]) != bits_of(static_cast<float>(k)));
        return count;
    };
    CHECK(differing(all_levels<std::uint8_t>(), 8) == 0);
    CHECK(differing(all_levels<std::uint16_t>(), 16) == 0);
}

TEST_CASE("real numbers as recorded stay as they are, however high", "[scale]") {
    const cv::Mat picture =
        (cv::Mat_<float>(1, 8) << 0.0F, 1.0F, 0.1F, 254.9F, 255.0F, 4321.0F, -3.0F, kNone);
    const DepthImage depth = DepthScale::as_recorded(kRealBits).image_of(picture);
    CHECK(depth.highest_level == 255.0);
    for (int i = 0; i < 7; ++i) {
        CAPTURE(i);
        CHECK(depth.at(i, 0) == picture.at<float>(0, i));
    }
    CHECK(std::isnan(depth.at(7, 0)));
}

TEST_CASE("a level beyond those that the bits allow stands as high as the highest", "[scale]") {
    const DepthScale scale(meaning_of(DepthUnit::levels, {1023.0, 0.0}), 10);
    const cv::Mat picture = (cv::Mat_<std::uint16_t>(1, 3) << 1023, 1024, 65535);
    const DepthImage depth = scale.image_of(picture);
    CHECK(depth.levels == std::vector<float>(3, scale(1023.0)));
}

TEST_CASE("the value at an elevation has that elevation", "[scale]") {
    const DepthMeaning meaning =
        GENERATE(meaning_of(DepthUnit::levels, {20.0, 10.0}, 0.1),
                 meaning_of(DepthUnit::mm, {500.0, 4500.0}), meaning_of(DepthUnit::m, {0.5, 4.5}),
                 meaning_of(DepthUnit::disparity, {100.0, 20.0}));
    const DepthScale scale(meaning, kRealBits);
    for (const double share : {0.0, 0.25, 1.0}) {
        const double value = value_at(meaning, share);
        CHECK_THAT(nearness_at(meaning, value), WithinAbs(share, 1e-9));
        CHECK_THAT(nearness(scale, value / meaning.scale.value), WithinAbs(share, 1e-6));
    }
    CHECK(nearness_at(meaning, 2.0 * meaning.range.value.near) != 1.0);  // not clamped
}

TEST_CASE("turned near and far mirror the relief, and turned twice they leave it as it was",
          "[scale]") {
    const DepthMeaning meaning = GENERATE(meaning_of(DepthUnit::levels, {200.0, 100.0}),
                                          meaning_of(DepthUnit::levels, {10.0, 20.0}, 0.1),
                                          meaning_of(DepthUnit::mm, {500.0, 4500.0}, 0.2),
                                          meaning_of(DepthUnit::m, {0.5, 4.5}, 0.0002));
    DepthMeaning other = meaning;
    merge_by_priority({{Origin::panel, turned_near_and_far(meaning)}}, other);
    DepthMeaning again = other;
    merge_by_priority({{Origin::panel, turned_near_and_far(other)}}, again);
    CHECK(other.unit.value == DepthUnit::levels);
    CHECK(other.near.value != meaning.near.value);
    for (const double share : {-0.2, 0.0, 0.3, 1.0, 1.2}) {
        const double level = value_at(meaning, share) / meaning.scale.value;
        const double before = nearness(DepthScale(meaning, 16), level);
        CHECK_THAT(nearness(DepthScale(other, 16), level), WithinAbs(1.0 - before, 1e-6));
        CHECK_THAT(nearness(DepthScale(again, 16), level), WithinAbs(before, 1e-6));
    }
}

TEST_CASE("turned disparities are distances without a unit, and a turned true shape is a relief",
          "[scale]") {
    DepthMeaning meaning = meaning_of(DepthUnit::disparity, {100.0, 20.0});
    meaning.geometry.value = Geometry::true_shape;
    const DepthStatement turned = turned_near_and_far(meaning);
    CHECK(turned.unit == DepthUnit::levels);
    CHECK(turned.near == NearLevels::dark);
    CHECK(turned.range == DepthRange{20.0, 100.0});
    CHECK(turned.geometry == Geometry::relief);
}
