// Two hundred pictures in colours that are no depth: none is opened as depth unasked.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/asks.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kWide = 192;
constexpr int kHigh = 144;
const cv::Size kPage{kWide, kHigh};

/// A colour of its own for each number.
cv::Scalar colour_of(int number) {
    const double angle = 2.4 * number;
    return {127.0 + 120.0 * std::cos(angle), 127.0 + 120.0 * std::cos(angle + 2.1),
            127.0 + 120.0 * std::cos(angle + 4.2)};
}

cv::Vec3b byte_colour(const cv::Scalar& colour) {
    return {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
            cv::saturate_cast<std::uint8_t>(colour[2])};
}

/// `value(x, y)`, both from 0 to 1, as 8 bits.
cv::Mat field(const std::function<double(double, double)>& value) {
    cv::Mat levels(kPage, CV_8UC1);
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i)
            levels.at<std::uint8_t>(j, i) = cv::saturate_cast<std::uint8_t>(
                255.0 * value(i / (kWide - 1.0), j / (kHigh - 1.0)));
    return levels;
}

cv::Mat mapped(const cv::Mat& levels, int colours) {
    cv::Mat picture;
    cv::applyColorMap(levels, picture, colours);
    return picture;
}

/// From one colour to another, along a direction.
cv::Mat gradient(int number) {
    const double angle = 0.7 * number;
    const cv::Mat part = field([angle](double x, double y) {
        return 0.5 + 0.5 * ((x - 0.5) * std::cos(angle) + (y - 0.5) * std::sin(angle));
    });
    cv::Mat picture(kPage, CV_8UC3);
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i) {
            const double share = part.at<std::uint8_t>(j, i) / 255.0;
            picture.at<cv::Vec3b>(j, i) =
                byte_colour(colour_of(number) * (1.0 - share) + colour_of(number + 1) * share);
        }
    return picture;
}

/// Things of several colours with the grain and the shadows of a photograph.
cv::Mat photograph(int number) {
    cv::Mat light = rough(kWide, kHigh, number);
    cv::Mat picture(kPage, CV_8UC3, colour_of(number));
    for (int k = 0; k < 6; ++k)
        cv::circle(picture, {(37 * k + 11 * number) % kWide, (53 * k + 17 * number) % kHigh},
                   12 + 4 * k, colour_of(number + k + 1), cv::FILLED);
    cv::cvtColor(light, light, cv::COLOR_GRAY2BGR);
    cv::multiply(picture, light, picture, 1.0 / 128.0);
    return picture;
}

cv::Mat bar_chart(int number) {
    cv::Mat picture(kPage, CV_8UC3, cv::Scalar::all(255.0));
    cv::line(picture, {12, kHigh - 12}, {kWide - 8, kHigh - 12}, cv::Scalar::all(30.0));
    for (int k = 0; k < 8; ++k)
        cv::rectangle(picture,
                      {18 + 21 * k, kHigh - 13 - (29 * k + 31 * number) % 100, 15,
                       (29 * k + 31 * number) % 100 + 1},
                      colour_of(number + k), cv::FILLED);
    return picture;
}

cv::Mat pie_chart(int number) {
    cv::Mat picture(kPage, CV_8UC3, cv::Scalar::all(250.0));
    double begin = 10.0 * number;
    for (int k = 0; k < 5; ++k) {
        const double end = begin + 40.0 + 16.0 * k;
        cv::ellipse(picture, cv::Point(kWide / 2, kHigh / 2), cv::Size(60, 60), 0.0, begin, end,
                    colour_of(number + k), cv::FILLED);
        begin = end;
    }
    return picture;
}

cv::Mat screenshot_of(int number) {
    cv::Mat picture(kPage, CV_8UC3, cv::Scalar(236.0, 232.0, 230.0));
    cv::rectangle(picture, {0, 0, kWide, 14}, colour_of(number), cv::FILLED);
    cv::rectangle(picture, {6, 22, 60, 110}, cv::Scalar::all(255.0), cv::FILLED);
    for (int k = 0; k < 8; ++k) {
        cv::putText(picture, "Row " + std::to_string(k * number), {10, 34 + 12 * k},
                    cv::FONT_HERSHEY_PLAIN, 0.7, cv::Scalar::all(40.0));
        cv::rectangle(picture, {74 + 28 * (k % 4), 26 + 44 * (k / 4), 22, 30},
                      colour_of(number + k), cv::FILLED);
    }
    return picture;
}

cv::Mat flag(int number) {
    cv::Mat picture(kPage, CV_8UC3);
    const int stripes = 2 + number % 4;
    for (int k = 0; k < stripes; ++k) {
        const int begin = k * (number % 2 == 0 ? kWide : kHigh) / stripes;
        const int end = (k + 1) * (number % 2 == 0 ? kWide : kHigh) / stripes;
        const cv::Rect stripe = number % 2 == 0 ? cv::Rect(begin, 0, end - begin, kHigh)
                                                : cv::Rect(0, begin, kWide, end - begin);
        picture(stripe).setTo(colour_of(number + k));
    }
    if (number % 3 == 0)
        cv::circle(picture, {kWide / 2, kHigh / 2}, 30, colour_of(number + 7), cv::FILLED);
    return picture;
}

/// A quantity of two others, with contour lines and a scale beside it, as programs plot it.
cv::Mat heat_map(int number) {
    constexpr std::array kMaps{cv::COLORMAP_JET,    cv::COLORMAP_HOT,     cv::COLORMAP_RAINBOW,
                               cv::COLORMAP_COOL,   cv::COLORMAP_INFERNO, cv::COLORMAP_VIRIDIS,
                               cv::COLORMAP_PLASMA, cv::COLORMAP_TURBO};
    const int colours = kMaps[static_cast<std::size_t>(number) % kMaps.size()];
    const cv::Mat plotted = mapped(field([number](double x, double y) {
                                       return 0.5 + 0.25 * std::sin(3.0 * x + number) +
                                              0.25 * std::cos(4.0 * y - 0.5 * number);
                                   }),
                                   colours);
    cv::Mat picture(kPage, CV_8UC3, cv::Scalar::all(255.0));
    cv::resize(plotted, picture(cv::Rect(16, 10, 130, 118)), {130, 118});
    const cv::Mat scale = mapped(field([](double, double y) { return 1.0 - y; }), colours);
    cv::resize(scale, picture(cv::Rect(158, 10, 10, 118)), {10, 118});
    for (int k = 0; k < 6; ++k)
        cv::putText(picture, std::to_string(20 * (5 - k)), {171, 14 + 22 * k},
                    cv::FONT_HERSHEY_PLAIN, 0.6, cv::Scalar::all(0.0));
    return picture;
}

/// Tables of correlations: squares in the colours of a map.
cv::Mat matrix_plot(int number) {
    const int side = 6 + number % 7;
    const cv::Mat levels = field([=](double x, double y) {
        const int row = static_cast<int>(y * side);
        const int column = static_cast<int>(x * side);
        return 0.5 + 0.5 * std::sin(1.7 * row * column + number);
    });
    return mapped(levels, number % 2 == 0 ? cv::COLORMAP_VIRIDIS : cv::COLORMAP_JET);
}

/// A street map: areas, roads, a river, names.
cv::Mat street_map(int number) {
    cv::Mat picture(kPage, CV_8UC3, cv::Scalar(220.0, 236.0, 238.0));
    for (int k = 0; k < 5; ++k)
        cv::rectangle(
            picture, {(41 * k + 13 * number) % 150, (29 * k + 23 * number) % 110, 38, 30},
            k % 2 == 0 ? cv::Scalar(170.0, 220.0, 175.0) : cv::Scalar(200.0, 205.0, 215.0),
            cv::FILLED);
    for (int k = 0; k < 7; ++k)
        cv::line(picture, {(31 * k + 7 * number) % kWide, 0}, {(67 * k + 29) % kWide, kHigh},
                 k % 3 == 0 ? cv::Scalar(120.0, 190.0, 250.0) : cv::Scalar::all(255.0), 1 + k % 3,
                 cv::LINE_AA);
    cv::line(picture, {0, (19 * number) % kHigh}, {kWide, kHigh / 2},
             cv::Scalar(220.0, 180.0, 120.0), 6, cv::LINE_AA);
    cv::putText(picture, "Park " + std::to_string(number), {60, 70}, cv::FONT_HERSHEY_PLAIN, 0.8,
                cv::Scalar::all(60.0));
    return picture;
}

/// Woven, tiled or spotted, as materials are.
cv::Mat weave(int number) {
    const double threads = 6.0 + number;
    const cv::Mat levels = field([=](double x, double y) {
        return 0.5 + 0.25 * std::sin(threads * 2.0 * std::numbers::pi * x) +
               0.25 * std::sin(threads * 1.3 * 2.0 * std::numbers::pi * y + x);
    });
    cv::Mat picture;
    cv::cvtColor(levels, picture, cv::COLOR_GRAY2BGR);
    cv::multiply(picture, cv::Mat(kPage, CV_8UC3, colour_of(number)), picture, 1.0 / 200.0);
    return picture;
}

/// Normals of a wavy surface, as a material has them beside its displacement.
cv::Mat normal_map(int number) {
    cv::Mat picture(kPage, CV_8UC3);
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i) {
            const double across = 0.5 * std::cos(0.1 * i * (1 + number % 3) + 0.3 * number);
            const double down = 0.5 * std::sin(0.13 * j + 0.2 * number);
            picture.at<cv::Vec3b>(j, i) =
                byte_colour({255.0 * std::sqrt(1.0 - across * across - down * down) / 2.0 + 127.0,
                             127.0 + 127.0 * down, 127.0 + 127.0 * across});
        }
    return picture;
}

/// Each pixel in the colour of what is there, as for training: flat areas of pure colours.
cv::Mat segmentation(int number) {
    cv::Mat picture(kPage, CV_8UC3, colour_of(number));
    for (int k = 0; k < 9; ++k)
        cv::ellipse(picture,
                    cv::Point((43 * k + 31 * number) % kWide, (37 * k + 11 * number) % kHigh),
                    cv::Size(10 + 5 * k % 30, 8 + 7 * k % 25), 20.0 * k, 0.0, 360.0,
                    colour_of(3 * k + number), cv::FILLED);
    return picture;
}

/// Directions as hues and lengths as saturation, as optical flow is painted.
cv::Mat flow_field(int number) {
    cv::Mat hsv(kPage, CV_8UC3);
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i) {
            const double x = i / (kWide - 1.0) - 0.2 - 0.06 * number;
            const double y = j / (kHigh - 1.0) - 0.5;
            const double degrees = 90.0 + 90.0 * std::atan2(y, x) / std::numbers::pi;
            hsv.at<cv::Vec3b>(j, i) = {cv::saturate_cast<std::uint8_t>(std::min(degrees, 179.0)),
                                       cv::saturate_cast<std::uint8_t>(400.0 * std::hypot(x, y)),
                                       255};
        }
    cv::Mat picture;
    cv::cvtColor(hsv, picture, cv::COLOR_HSV2BGR);
    return picture;
}

struct Kind {
    const char* name;
    cv::Mat (*draw)(int number);
    int count;
};
constexpr std::array kKinds{
    Kind{"gradient", gradient, 20},        Kind{"photograph", photograph, 20},
    Kind{"bar chart", bar_chart, 14},      Kind{"pie chart", pie_chart, 12},
    Kind{"screenshot", screenshot_of, 14}, Kind{"flag", flag, 16},
    Kind{"heat map", heat_map, 24},        Kind{"matrix", matrix_plot, 14},
    Kind{"street map", street_map, 14},    Kind{"weave", weave, 16},
    Kind{"normals", normal_map, 12},       Kind{"segmentation", segmentation, 14},
    Kind{"optical flow", flow_field, 10}};

/// "depth" where it is opened as depth unasked, else nothing or the line that refuses it.
std::string opened_as(const std::filesystem::path& file) {
    try {
        const auto media = open_media(file, {}, {.find_out = true});
        return asks(media->description()) ? "" : "depth";
    } catch (const InputError& error) {
        return error.what();
    }
}

}  // namespace

TEST_CASE("two hundred coloured pictures are not taken for depth unasked", "[kind]") {
    const TemporaryFolder folder;
    const std::string ending = GENERATE(".png", ".jpg");
    int pictures = 0;
    for (const Kind& kind : kKinds) {
        for (int number = 0; number < kind.count; ++number, ++pictures) {
            CAPTURE(kind.name, number, ending);
            const std::filesystem::path file =
                folder / ("IMG_" + std::to_string(1000 + pictures) + ending);
            REQUIRE(cv::imwrite(file.string(), kind.draw(number)));
            const std::string line = opened_as(file);
            CHECK(line != "depth");
            if (!line.empty() && line != "depth") CHECK(contains(line, "needs a depth file"));
            std::filesystem::remove(file);
        }
    }
    CHECK(pictures >= 200);
}
