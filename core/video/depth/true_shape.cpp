// Draws the camera's surface into an orthographic grid, triangle by triangle.
#include "core/video/depth/true_shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kUsualPoints = 1 << 19;  ///< most points of a grid; more for larger pictures
constexpr double kWidestRay = 20.0;       ///< sideways over forwards: 87 degrees
constexpr double kNarrowestView = 0.005;  ///< width of a picture, likewise: 0.3 degrees

/// A steeper triangle is an edge with background behind it [pixels of height to a pixel sideways]:
/// 86.4 degrees. So a sphere is whole up to its last pixel, and the noise of sensors, a hundredth
/// or two of the distance, does not tear a surface.
constexpr double kSteepest = 16.0;
/// A larger step is an edge, too, as a part of the distance, whatever the size of a pixel.
constexpr double kMostStep = 0.05;

/// A triangle counts this far outside its border, so that there is no gap between two [share].
constexpr float kOverlap = 1e-4F;

/// Range along one axis: of rays (sideways over forwards), or of places [mm].
struct Extent {
    double begin{0.0};
    double end{0.0};

    [[nodiscard]] double length() const { return end - begin; }
};

/// The range of rays.
Extent span_of(const cv::Mat& rays) {
    Extent span;
    cv::minMaxLoc(rays, &span.begin, &span.end, nullptr, nullptr, rays == rays);
    return span;
}

void require_camera(bool is_camera) {
    if (!is_camera)
        throw InputError(
            "the intrinsics cannot be those of the camera that took this picture: give its focal "
            "lengths and its centre in depth pixels, FX,FY,CX,CY");
}

void require_view(const Extent& rays) {
    require_camera(rays.length() >= kNarrowestView && rays.begin >= -kWidestRay &&
                   rays.end <= kWidestRay);
}

void require_range(const DepthRange& range_mm) {
    const bool is_range =
        range_mm.near > 0.0 && range_mm.far > range_mm.near && std::isfinite(range_mm.far);
    if (!is_range)
        throw InputError("true shape needs a depth range of distances, the nearest above 0: not " +
                         short_text(range_mm.near) + " to " + short_text(range_mm.far) + " mm");
}

/// What rays see between two distances [mm].
Extent extent_of(const Extent& rays, const DepthRange& range_mm) {
    return {std::min(rays.begin * range_mm.near, rays.begin * range_mm.far),
            std::max(rays.end * range_mm.near, rays.end * range_mm.far)};
}

/// Places of the samples' pixels that are in the range [mm].
struct Places {
    std::vector<float> x{};
    std::vector<float> y{};
};

/// Takes one pixel of 4 x 4, which is enough.
Places places_in(const std::vector<cv::Mat>& samples_mm, const Rays& rays,
                 const DepthRange& range_mm) {
    constexpr int kStep = 4;
    Places places;
    for (const cv::Mat& sample : samples_mm) {
        for (int j = 0; j < sample.rows; j += kStep) {
            for (int i = 0; i < sample.cols; i += kStep) {
                const double distance = double{sample.at<float>(j, i)};
                const double right = double{rays.right.at<float>(j, i)};
                if (!(distance >= range_mm.near && distance <= range_mm.far)) continue;
                if (std::isnan(right)) continue;
                places.x.push_back(static_cast<float>(distance * right));
                places.y.push_back(
                    static_cast<float>(distance * double{rays.down.at<float>(j, i)}));
            }
        }
    }
    return places;
}

/// The part of an extent with nearly all places, and some more; all of it if there are no places.
Extent around(std::vector<float>& places, const Extent& all) {
    constexpr double kLeftOut = 0.002;
    constexpr double kMore = 0.1;
    if (places.empty()) return all;
    const auto quantile = [&places](double share) {
        const auto rank = static_cast<std::ptrdiff_t>(
            std::lround(share * static_cast<double>(places.size() - 1)));
        std::nth_element(places.begin(), places.begin() + rank, places.end());
        return double{places[static_cast<std::size_t>(rank)]};
    };
    const double begin = quantile(kLeftOut);
    const double end = quantile(1.0 - kLeftOut);
    const double more = kMore * (end - begin);
    return {std::max(all.begin, begin - more), std::min(all.end, end + more)};
}

/// Mean focal length (geometric) of both axes [px].
double focal_length(const CameraModel& camera) {
    return std::sqrt(camera.intrinsics().fx * camera.intrinsics().fy);
}

/// Centres the points of the grid in the extent, along one axis.
void lay_out(const Extent& extent, double pitch_mm, int& count, double& first_mm) {
    count = std::max(2, static_cast<int>(extent.length() / pitch_mm) + 1);
    first_mm = 0.5 * (extent.begin + extent.end - (count - 1) * pitch_mm);
}

/// The first whole number not below a coordinate of the grid, and the last not above it, with
/// kOverlap. Below 0 the first one is 0; the last one may be 0, too, as cutting off the fraction,
/// which is faster than rounding down, rounds negative numbers up.
int first_from(float coordinate) {
    return std::max(0, static_cast<int>(coordinate + (1.0F - kOverlap)));
}
int last_to(float coordinate) {
    return static_cast<int>(coordinate + kOverlap);
}

}  // namespace

OrthographicGrid orthographic_grid(cv::Size depth_size, const CameraModel& camera,
                                   const DepthRange& range_mm,
                                   const std::vector<cv::Mat>& samples_mm) {
    require_range(range_mm);
    require_camera(is_camera(camera.intrinsics()));
    const Rays rays = rays_of(depth_size, camera);
    const Extent across = span_of(rays.right);
    const Extent down = span_of(rays.down);
    require_view(across);
    require_view(down);
    Places places = places_in(samples_mm, rays, range_mm);
    const Extent width = around(places.x, extent_of(across, range_mm));
    const Extent height = around(places.y, extent_of(down, range_mm));
    const double nearest_pixel_mm = range_mm.near / focal_length(camera);
    const double most_points = std::max(kUsualPoints, 1.0 * depth_size.width * depth_size.height);
    OrthographicGrid grid;
    grid.pitch_mm =
        std::max({nearest_pixel_mm, std::sqrt(width.length() * height.length() / most_points),
                  width.length() / kMostSide_px, height.length() / kMostSide_px});
    lay_out(width, grid.pitch_mm, grid.columns, grid.left_mm);
    lay_out(height, grid.pitch_mm, grid.rows, grid.top_mm);
    return grid;
}

TrueShape::TrueShape(cv::Size depth_size, const CameraModel& camera, const DepthRange& range_mm,
                     const OrthographicGrid& grid)
    : depth_size_(depth_size),
      camera_(camera),
      rays_(rays_of(depth_size, camera)),
      range_mm_(range_mm),
      grid_(grid),
      steepest_(static_cast<float>(std::min(kSteepest / focal_length(camera), kMostStep))) {}

OrthographicPicture TrueShape::orthographic_view(const cv::Mat& depth_mm, const cv::Mat& colour) {
    assert(depth_mm.type() == CV_32FC1 && depth_mm.size() == depth_size_);
    OrthographicPicture picture;
    DepthImage& image = picture.depth;
    image.columns = grid_.columns;
    image.rows = grid_.rows;
    // Rounded like the elevations, so that none is higher.
    image.highest_level =
        double{static_cast<float>(range_mm_.far) - static_cast<float>(range_mm_.near)};
    image.levels.assign(
        static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows), kNothing);
    place_row(depth_mm, 0, below_);
    for (int row = 1; row < depth_mm.rows; ++row) {
        std::swap(above_, below_);
        place_row(depth_mm, row, below_);
        for (std::size_t i = 0; i + 1 < above_.size(); ++i) {
            draw(above_[i], above_[i + 1], below_[i], image);
            draw(below_[i + 1], below_[i], above_[i + 1], image);
        }
    }
    if (!colour.empty()) picture.colour = colour_on(image, colour);
    return picture;
}

void TrueShape::place_row(const cv::Mat& depth_mm, int row, std::vector<Corner>& corners) const {
    const float* const distances_mm = depth_mm.ptr<float>(row);
    const auto near = static_cast<float>(range_mm_.near);
    const auto far = static_cast<float>(range_mm_.far);
    const auto left = static_cast<float>(grid_.left_mm / grid_.pitch_mm);
    const auto top = static_cast<float>(grid_.top_mm / grid_.pitch_mm);
    const auto per_mm = static_cast<float>(1.0 / grid_.pitch_mm);
    const float* const right = rays_.right.ptr<float>(row);
    const float* const down = rays_.down.ptr<float>(row);
    corners.resize(static_cast<std::size_t>(depth_mm.cols));
    for (int i = 0; i < depth_mm.cols; ++i) {
        const float distance = distances_mm[i];
        const bool has_data = distance > 0.0F && std::isfinite(distance);
        const float held = has_data ? std::clamp(distance, near, far) : kNothing;
        const float held_px = held * per_mm;
        corners[static_cast<std::size_t>(i)] = {right[i] * held_px - left, down[i] * held_px - top,
                                                far - held};
    }
}

/// Draws the elevations at the grid points inside a triangle. A triangle seen from its back is left
/// out: it faces away from the orthographic view, and something nearer covers it.
void TrueShape::draw(const Corner& a, const Corner& b, const Corner& c, DepthImage& image) const {
    const float b_x = b.x - a.x, b_y = b.y - a.y;
    const float c_x = c.x - a.x, c_y = c.y - a.y;
    const float twice_area = b_x * c_y - b_y * c_x;
    if (!(twice_area > 0.0F)) return;  // NaN: without data
    const auto [lowest, highest] = std::minmax({a.elevation, b.elevation, c.elevation});
    const float nearest = static_cast<float>(range_mm_.far) - highest;
    if (highest - lowest > steepest_ * nearest) return;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const int first_column = first_from(left);
    const int last_column = std::min(last_to(right), image.columns - 1);
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const int first_row = first_from(top);
    const int last_row = std::min(last_to(bottom), image.rows - 1);
    if (first_column > last_column || first_row > last_row) return;

    const float scale = 1.0F / twice_area;
    const float b_higher = b.elevation - a.elevation;
    const float c_higher = c.elevation - a.elevation;
    for (int row = first_row; row <= last_row; ++row) {
        float* const levels = &image.levels[image.index(0, row)];
        const float y = static_cast<float>(row) - a.y;
        for (int column = first_column; column <= last_column; ++column) {
            const float x = static_cast<float>(column) - a.x;
            const float share_b = (x * c_y - y * c_x) * scale;
            const float share_c = (y * b_x - x * b_y) * scale;
            if (std::min({share_b, share_c, 1.0F - share_b - share_c}) < -kOverlap) continue;
            const float elevation =
                std::clamp(a.elevation + share_b * b_higher + share_c * c_higher, lowest, highest);
            if (!(levels[column] >= elevation)) levels[column] = elevation;  // NaN: the first one
        }
    }
}

/// Finds the place in the colour picture of the surface at every point of the grid.
void TrueShape::find_pixels(const DepthImage& image, cv::Size colour_size) {
    constexpr float kOutside = -2.0F;
    const FloatLens lens(camera_.lens());
    const Intrinsics& pinhole = camera_.intrinsics();
    const double across = 1.0 * colour_size.width / depth_size_.width;
    const double down = 1.0 * colour_size.height / depth_size_.height;
    const auto focal_x = static_cast<float>(pinhole.fx * across);
    const auto focal_y = static_cast<float>(pinhole.fy * down);
    const auto centre_x = static_cast<float>((pinhole.cx + 0.5) * across - 0.5);
    const auto centre_y = static_cast<float>((pinhole.cy + 0.5) * down - 0.5);
    const auto last_x = static_cast<float>(colour_size.width - 1);
    const auto last_y = static_cast<float>(colour_size.height - 1);
    const auto far = static_cast<float>(range_mm_.far);
    const auto left_mm = static_cast<float>(grid_.left_mm);
    const auto pitch_mm = static_cast<float>(grid_.pitch_mm);
    pixel_x_.create(image.rows, image.columns, CV_32FC1);
    pixel_y_.create(image.rows, image.columns, CV_32FC1);
    for (int j = 0; j < image.rows; ++j) {
        const float* const levels = &image.levels[image.index(0, j)];
        float* const xs = pixel_x_.ptr<float>(j);
        float* const ys = pixel_y_.ptr<float>(j);
        const auto y_mm = static_cast<float>(grid_.top_mm + j * grid_.pitch_mm);
        for (int i = 0; i < image.columns; ++i) {
            const float nearness = 1.0F / (far - levels[i]);
            const float x_mm = left_mm + static_cast<float>(i) * pitch_mm;
            const FloatLens::Distorted seen = lens.distorted(x_mm * nearness, y_mm * nearness);
            const float x = centre_x + focal_x * seen.x;
            const float y = centre_y + focal_y * seen.y;
            xs[i] = seen.known ? std::clamp(x, 0.0F, last_x) : kOutside;
            ys[i] = seen.known ? std::clamp(y, 0.0F, last_y) : kOutside;
        }
    }
}

ColourImage TrueShape::colour_on(const DepthImage& image, const cv::Mat& colour) {
    const cv::Mat source = resampleable(colour);
    find_pixels(image, source.size());
    cv::Mat resampled;
    cv::remap(source, resampled, pixel_x_, pixel_y_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    return colour_of(resampled);
}

}  // namespace dibhr
