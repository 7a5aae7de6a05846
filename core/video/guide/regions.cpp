// Looks regions up by place and time, and raises their outlines.
#include "core/video/guide/regions.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace dibhr {

namespace {

// Shares of the picture's width. Of 101.6 mm: 0.8 mm high, and 1.1 mm wide at half the height.
constexpr double kRidgeHeight = 0.008;
constexpr double kRidgeSigma = 0.0045;

/// 1 on each pixel whose right or lower neighbour belongs to another region.
cv::Mat outlines_of(const Regions& regions, int picture) {
    cv::Mat lines = cv::Mat::zeros(regions.rows, regions.columns, CV_32F);
    for (int j = 0; j < regions.rows; ++j) {
        for (int i = 0; i < regions.columns; ++i) {
            const std::uint8_t here = regions.label(picture, i, j);
            const auto differs = [&](int column, int row) {
                return column < regions.columns && row < regions.rows &&
                       regions.label(picture, column, row) != here;
            };
            if (differs(i + 1, j) || differs(i, j + 1)) lines.at<float>(j, i) = 1.0F;
        }
    }
    return lines;
}

int label_place(double place_px, int image_size, int label_size) noexcept {
    return static_cast<int>(std::floor((place_px + 0.5) / image_size * label_size));
}

}  // namespace

int Regions::picture_at(double media_s) const noexcept {
    const double at = std::floor(media_s * pictures_per_s);
    return static_cast<int>(std::clamp(at, 0.0, pictures - 1.0));
}

std::uint8_t Regions::label(int picture, int i, int j) const noexcept {
    if (i < 0 || j < 0 || i >= columns || j >= rows) return 0;
    const auto row = static_cast<std::size_t>(picture) * static_cast<std::size_t>(rows) +
                     static_cast<std::size_t>(j);
    return labels[row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
}

const Region* Regions::at(double x, double y, int image_columns, int image_rows,
                          double media_s) const noexcept {
    if (!std::isfinite(x) || !std::isfinite(y)) return nullptr;
    const std::uint8_t found = label(picture_at(media_s), label_place(x, image_columns, columns),
                                     label_place(y, image_rows, rows));
    return found == 0 ? nullptr : &regions[found - 1U];
}

TouchMap ridges_of(const Regions& regions, int picture, int image_columns) {
    const double sigma_px = std::max(kRidgeSigma * regions.columns, 0.5);
    cv::Mat ridges;
    cv::GaussianBlur(outlines_of(regions, picture), ridges, {}, sigma_px);
    TouchMap map = bare_map(TouchMapKind::height, regions.columns, regions.rows);
    map.limits = {0.0, kRidgeHeight * image_columns};
    // A straight line of width 1 is so high after the blur; corners are cut off at that height.
    const double on_line = 1.0 / (sigma_px * std::sqrt(2.0 * CV_PI));
    for (int j = 0; j < map.rows; ++j) {
        for (int i = 0; i < map.columns; ++i) {
            const double share =
                std::min(1.0, static_cast<double>(ridges.at<float>(j, i)) / on_line);
            map.at(i, j) = {map.level_of(share * map.limits.highest),
                            static_cast<std::uint16_t>(TouchMap::kWhole)};
        }
    }
    return map;
}

}  // namespace dibhr
