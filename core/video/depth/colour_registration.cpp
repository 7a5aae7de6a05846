// Projects the depth camera's surface into the colour camera's picture.
#include "core/video/depth/colour_registration.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/video/cleaning/patches.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

constexpr float kNoDistance = std::numeric_limits<float>::infinity();

/// A pixel this many times as far as the nearest one in its cell is hidden by it. A slanted surface
/// falls by less within a cell.
constexpr float kBehind = 1.03F;

/// Width of a cell over the distance of depth pixels in the colour picture: so the background is
/// not seen through gaps of a surface or along its edge.
constexpr double kCellWidth = 2.5;

}  // namespace

cv::Mat apply_registration(const cv::Mat& colour, const Registration& registration,
                           cv::Size depth_size) {
    if (colour.empty() || registration == Registration{}) return colour;
    const cv::Mat source = resampleable(colour);
    const double across = 1.0 * source.cols / depth_size.width;
    const double down = 1.0 * source.rows / depth_size.height;
    const double stays = 1.0 - registration.scale;
    const double x = registration.right_px * across + stays * 0.5 * (source.cols - 1);
    const double y = registration.down_px * down + stays * 0.5 * (source.rows - 1);
    const cv::Matx23d place{registration.scale, 0.0, x, 0.0, registration.scale, y};
    cv::Mat result;
    cv::warpAffine(source, result, place, source.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                   cv::Scalar::all(kNoColour));
    return result;
}

ColourRegistration::ColourRegistration(cv::Size depth_size, const CameraPair& cameras,
                                       double far_mm)
    : cameras_(cameras),
      far_mm_(static_cast<float>(far_mm)),
      rays_(rays_of(depth_size, cameras.depth)) {}

cv::Mat ColourRegistration::seen_from_depth(const cv::Mat& depth_mm, const cv::Mat& colour) {
    assert(depth_mm.type() == CV_32FC1 && depth_mm.size() == rays_.right.size());
    const cv::Mat source = resampleable(colour);
    const CameraModel camera = camera_for(source.size(), cameras_.colour, cameras_.colour_size);
    const double pixels_apart = camera.intrinsics().fx / cameras_.depth.intrinsics().fx;
    close_holes(depth_mm);
    project(camera);
    find_hidden(source.size(), pixels_apart);
    uncover();
    const bool is_finer =
        pixels_apart > 1.5 && 2 * std::max(depth_mm.cols, depth_mm.rows) < kMostSide_px;
    if (is_finer) {
        make_finer(x_, pixels_apart, finer_x_);
        make_finer(y_, pixels_apart, finer_y_);
    }
    cv::Mat result;
    cv::remap(source, result, is_finer ? finer_x_ : x_, is_finer ? finer_y_ : y_, cv::INTER_LINEAR,
              cv::BORDER_CONSTANT, cv::Scalar::all(kNoColour));
    return result;
}

/// Fills holes of a row from their farther end; a row without data is as far as the farthest pixel.
void ColourRegistration::close_holes(const cv::Mat& depth_mm) {
    depth_mm.copyTo(depth_mm_);
    double farthest = 0.0;
    cv::minMaxLoc(depth_mm, nullptr, &farthest, nullptr, nullptr, depth_mm == depth_mm);
    const float all_mm = farthest > 0.0 ? static_cast<float>(farthest) : far_mm_;
    for (int j = 0; j < depth_mm_.rows; ++j) {
        float* const row = depth_mm_.ptr<float>(j);
        visit_runs(
            row, depth_mm_.cols, [](float distance) { return !is_data(distance); },
            [&](int begin, int end) {
                float behind = 0.0F;
                if (begin > 0) behind = row[begin - 1];
                if (end < depth_mm_.cols) behind = std::max(behind, row[end]);
                if (!(behind > 0.0F)) behind = all_mm;
                std::fill(row + begin, row + end, behind);
            });
    }
}

/// Row by row and without branches, as it runs for every pixel of every frame.
void ColourRegistration::project(const CameraModel& colour) {
    constexpr float kOutside = -1e4F;
    constexpr float kFar = 1e5F;  // px; limit for places outside of the picture
    const cv::Size size = depth_mm_.size();
    for (cv::Mat* const map : {&x_, &y_, &distance_mm_}) map->create(size, CV_32FC1);
    const cv::Matx33f rotation = cameras_.to_colour.rotation;
    const cv::Vec3f shift = cameras_.to_colour.shift_mm;
    const Intrinsics& pinhole = colour.intrinsics();
    const auto fx = static_cast<float>(pinhole.fx), fy = static_cast<float>(pinhole.fy);
    const auto cx = static_cast<float>(pinhole.cx), cy = static_cast<float>(pinhole.cy);
    const FloatLens lens(colour.lens());
    for (int j = 0; j < size.height; ++j) {
        const float* const right = rays_.right.ptr<float>(j);
        const float* const down = rays_.down.ptr<float>(j);
        const float* const depth = depth_mm_.ptr<float>(j);
        float* const xs = x_.ptr<float>(j);
        float* const ys = y_.ptr<float>(j);
        float* const distances = distance_mm_.ptr<float>(j);
        for (int i = 0; i < size.width; ++i) {
            const float x = right[i] * depth[i], y = down[i] * depth[i], z = depth[i];
            const float there_x = rotation(0, 0) * x + rotation(0, 1) * y + rotation(0, 2) * z;
            const float there_y = rotation(1, 0) * x + rotation(1, 1) * y + rotation(1, 2) * z;
            const float there_z = rotation(2, 0) * x + rotation(2, 1) * y + rotation(2, 2) * z;
            const float distance = there_z + shift[2];
            const float ray_x = (there_x + shift[0]) / distance;
            const float ray_y = (there_y + shift[1]) / distance;
            const FloatLens::Distorted seen = lens.distorted(ray_x, ray_y);
            const bool is_seen = distance > 0.0F && seen.known;  // false for NaN
            xs[i] = is_seen ? std::clamp(cx + fx * seen.x, kOutside, kFar) : kOutside;
            ys[i] = is_seen ? std::clamp(cy + fy * seen.y, kOutside, kFar) : kOutside;
            distances[i] = distance;
        }
    }
}

void ColourRegistration::find_hidden(cv::Size colour_size, double pixels_apart) {
    const auto cells = static_cast<float>(1.0 / std::max(kCellWidth * pixels_apart, 1.0));
    const int columns = static_cast<int>(static_cast<float>(colour_size.width) * cells) + 1;
    const int rows = static_cast<int>(static_cast<float>(colour_size.height) * cells) + 1;
    nearest_mm_.create(rows, columns, CV_32FC1);
    nearest_mm_.setTo(kNoDistance);
    const auto visit = [&](const auto& visit_cell) {
        for (int j = 0; j < x_.rows; ++j) {
            for (int i = 0; i < x_.cols; ++i) {
                const float x = x_.at<float>(j, i) * cells;
                const float y = y_.at<float>(j, i) * cells;
                if (!(x >= 0.0F && y >= 0.0F)) continue;
                const int column = static_cast<int>(x);
                const int row = static_cast<int>(y);
                if (column < columns && row < rows)
                    visit_cell(j, i, nearest_mm_.at<float>(row, column));
            }
        }
    };
    visit([this](int j, int i, float& nearest) {
        nearest = std::min(nearest, distance_mm_.at<float>(j, i));
    });
    hidden_.create(x_.size(), CV_8UC1);
    hidden_.setTo(0);
    visit([this](int j, int i, float nearest) {
        hidden_.at<unsigned char>(j, i) = distance_mm_.at<float>(j, i) > kBehind * nearest ? 1 : 0;
    });
}

/// Four places for every pixel, a quarter of a pixel to each side. On one surface they are
/// interpolated towards the next pixel; if that is too far away there is an edge between, and each
/// side keeps its own place.
void ColourRegistration::make_finer(const cv::Mat& map, double pixels_apart, cv::Mat& finer) {
    const auto most = static_cast<float>(2.0 * pixels_apart);
    const auto towards = [most](float own, float next) {
        const float step = next - own;
        return std::fabs(step) <= most ? 0.25F * step : 0.0F;
    };
    finer.create(2 * map.rows, 2 * map.cols, CV_32FC1);
    for (int j = 0; j < map.rows; ++j) {
        const float* const row = map.ptr<float>(j);
        const float* const above = map.ptr<float>(std::max(j - 1, 0));
        const float* const below = map.ptr<float>(std::min(j + 1, map.rows - 1));
        float* upper = finer.ptr<float>(2 * j);
        float* lower = finer.ptr<float>(2 * j + 1);
        for (int i = 0; i < map.cols; ++i) {
            const float left = row[i] + towards(row[i], row[std::max(i - 1, 0)]);
            const float right = row[i] + towards(row[i], row[std::min(i + 1, map.cols - 1)]);
            const float up = towards(row[i], above[i]);
            const float down = towards(row[i], below[i]);
            *upper++ = left + up;
            *upper++ = right + up;
            *lower++ = left + down;
            *lower++ = right + down;
        }
    }
}

/// Hidden pixels take the colour at the farther end of their run in the row: the background's.
void ColourRegistration::uncover() {
    for (int j = 0; j < x_.rows; ++j) {
        const unsigned char* const hidden = hidden_.ptr<unsigned char>(j);
        const float* const distance = distance_mm_.ptr<float>(j);
        float* const x = x_.ptr<float>(j);
        float* const y = y_.ptr<float>(j);
        visit_runs(
            hidden, x_.cols, [](unsigned char is_hidden) { return is_hidden != 0; },
            [&](int begin, int end) {
                const bool has_left = begin > 0;
                const bool has_right = end < x_.cols;
                if (!has_left && !has_right) return;
                const bool take_right =
                    has_right && (!has_left || distance[end] > distance[begin - 1]);
                const int from = take_right ? end : begin - 1;
                std::fill(x + begin, x + end, x[from]);
                std::fill(y + begin, y + end, y[from]);
            });
    }
}

}  // namespace dibhr
