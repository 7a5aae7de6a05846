// Formulas for the panels, and their measures.
#include "tests/bench/detail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/core/video/moving_scene.hpp"

namespace dibhr::bench {

namespace {

constexpr int kColumns = 320;
constexpr int kPanelRows = 40;
constexpr std::size_t kFlatPanel = 0;
constexpr std::size_t kStepPanel = kRidges.size() + 1;
constexpr int kRows = kPanelRows * static_cast<int>(kStepPanel + 1);
constexpr int kPanelMargin_px = 6;  ///< not measured: what is above and below is in reach
constexpr int kMargin_px = 16;      ///< to the left and the right
constexpr double kPlane_mm = 1000.0;
constexpr double kTilt_mm_per_px = 0.05 * kPlane_mm / 525.0;
constexpr double kStepEvery_px = 40.0;
constexpr double kStepWithin_px = 4.0;

double plane_mm(double x_px) {
    return kPlane_mm + kTilt_mm_per_px * (x_px - 0.5 * kColumns);
}

/// Of a panel, towards the camera; `x_px`: on the plane.
double relief_mm(std::size_t panel, double x_px) {
    if (panel == kFlatPanel) return 0.0;
    if (panel == kStepPanel)
        return std::lround(std::floor(x_px / kStepEvery_px)) % 2 == 0 ? kStep_mm : 0.0;
    const Ridges& ridges = kRidges[panel - 1];
    return ridges.amplitude_mm * std::sin(2.0 * std::numbers::pi * x_px / ridges.period_px);
}

/// What is above the first one and below the last one is a part of it.
std::size_t panel_at(double y_px) {
    return static_cast<std::size_t>(std::clamp(y_px + 0.5, 0.0, kRows - 0.5)) /
           static_cast<std::size_t>(kPanelRows);
}

/// On the plane [px at 1 m], as a place in the picture shows it.
struct Place {
    double x, y;
    double nearer_mm;  ///< than 1 m
};

Place place_at(const CameraPath& path, double frame, double x, double y) {
    const double nearer_mm = path.nearer_mm * (frame - kAtOneMetre);
    if (path.roll == 0.0 && path.nearer_mm == 0.0) return {x + path.right_px * frame, y, 0.0};
    const double right = x - 0.5 * kColumns;
    const double down = y - 0.5 * kRows;
    const double far = 1.0 - nearer_mm / kPlane_mm;
    const double across = far * std::cos(path.roll * frame);
    const double along = far * std::sin(path.roll * frame);
    return {0.5 * kColumns + across * right - along * down + path.right_px * frame,
            0.5 * kRows + along * right + across * down, nearer_mm};
}

/// Towards the camera, from the plane.
double measured_mm(const DepthImage& depth, int i, int j, const Place& place) {
    const auto level = static_cast<double>(depth.at(i, j));
    return plane_mm(place.x) - place.nearer_mm -
           distance_mm(level * kRelief_px / depth.highest_level);
}

/// Whether all that is in reach is of one panel.
bool is_inside(double y_px) {
    const double in_panel = y_px - kPanelRows * std::floor(y_px / kPanelRows);
    return y_px >= 0.0 && y_px < kRows && in_panel >= kPanelMargin_px &&
           in_panel < kPanelRows - kPanelMargin_px;
}

int first_row(std::size_t panel) {
    return static_cast<int>(panel) * kPanelRows + kPanelMargin_px;
}

int end_row(std::size_t panel) {
    return static_cast<int>(panel + 1) * kPanelRows - kPanelMargin_px;
}

DepthImage flat_panel(const DepthImage& depth) {
    return image_of(
        kColumns - 2 * kMargin_px, end_row(kFlatPanel) - first_row(kFlatPanel), depth.highest_level,
        [&](int i, int j) {
            return static_cast<double>(depth.at(i + kMargin_px, j + first_row(kFlatPanel)));
        });
}

}  // namespace

KnownScene detail_scene(const CameraPath& path) {
    KnownScene scene{.name = "detail", .columns = kColumns, .rows = kRows};
    scene.moves = path.moves();
    scene.at = [path](double frame, double x, double y) {
        const Place place = place_at(path, frame, x, y);
        return Seen{elevation_px(plane_mm(place.x) - place.nearer_mm -
                                 relief_mm(panel_at(place.y), place.x)),
                    0};
    };
    return scene;
}

std::vector<ColourImage> detail_colours(const CameraPath& path, int frames, std::uint32_t seed) {
    constexpr double kMean = 128.0, kNoise = 2.0;
    constexpr int kTexture = 3;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, kNoise);
    std::vector<ColourImage> colours;
    for (int k = 0; k < frames; ++k) {
        ColourImage& colour = colours.emplace_back(ColourImage{kColumns, kRows, {}});
        for (int j = 0; j < kRows; ++j)
            for (int i = 0; i < kColumns; ++i) {
                const Place place = place_at(path, k, i, j);
                const double bright =
                    kMean + test::texture(place.x, place.y, kTexture) + normal(random);
                const auto grey = static_cast<std::uint8_t>(std::clamp(bright, 0.0, 255.0));
                colour.rgb.insert(colour.rgb.end(), 3, grey);
            }
    }
    return colours;
}

void DetailMeter::Share::add(double true_mm, double seen_mm) {
    count += 1.0;
    relief += true_mm;
    measured += seen_mm;
    squares += true_mm * true_mm;
    products += true_mm * seen_mm;
}

double DetailMeter::Share::share() const {
    return (products - relief * measured / count) / (squares - relief * relief / count);
}

void DetailMeter::add(int frame, const DepthImage& depth, const DepthImage& next) {
    for (int j = kPanelMargin_px; j < kRows - kPanelMargin_px; ++j)
        for (int i = kMargin_px; i < kColumns - kMargin_px; ++i) {
            const Place place = place_at(path_, frame, i, j);
            const std::size_t panel = panel_at(place.y);
            if (!is_inside(place.y) || panel == kStepPanel) continue;
            const double measured = measured_mm(depth, i, j, place);
            if (panel == kFlatPanel) {
                squares_mm2_ += measured * measured;
                pixels_ += 1.0;
            } else {
                ridges_[panel - 1].add(relief_mm(panel, place.x), measured);
            }
        }
    add_steps(frame, depth);
    flat_.add(flat_panel(depth), flat_panel(next));
}

/// Of the mean of all rows, between columns.
void DetailMeter::add_steps(int frame, const DepthImage& depth) {
    if (path_.roll != 0.0 || path_.nearer_mm != 0.0) return;
    const double gone_px = path_.right_px * frame;
    std::vector<double> profile_mm(kColumns, 0.0);
    constexpr int kMeasuredRows = kPanelRows - 2 * kPanelMargin_px;
    for (int j = first_row(kStepPanel); j < end_row(kStepPanel); ++j)
        for (int i = 0; i < kColumns; ++i)
            profile_mm[static_cast<std::size_t>(i)] +=
                measured_mm(depth, i, j, {i + gone_px, 0.0, 0.0}) / kMeasuredRows;
    const auto height_mm = [&](double i) {
        const auto left = static_cast<std::size_t>(i);
        return std::lerp(profile_mm[left], profile_mm[left + 1], i - std::floor(i));
    };
    const auto first = static_cast<int>(std::ceil((gone_px + kMargin_px) / kStepEvery_px));
    for (int k = first; k * kStepEvery_px - gone_px < kColumns - kMargin_px; ++k) {
        // The first pixel of the next side has its middle there, or up to a pixel behind.
        const double at = std::ceil(k * kStepEvery_px - gone_px) - 0.5;
        const double rise_mm =
            height_mm(at + 0.5 * kStepWithin_px) - height_mm(at - 0.5 * kStepWithin_px);
        rise_mm_ += k % 2 == 0 ? rise_mm : -rise_mm;
        rises_ += 1.0;
    }
}

Detail DetailMeter::detail() const {
    Detail detail;
    for (std::size_t k = 0; k < kRidges.size(); ++k) detail.ridges[k] = ridges_[k].share();
    detail.step =
        rises_ > 0.0 ? rise_mm_ / rises_ / kStep_mm : std::numeric_limits<double>::quiet_NaN();
    detail.noise_mm = std::sqrt(squares_mm2_ / pixels_);
    detail.flat = flat_.blemishes();
    return detail;
}

DepthImage mean_of(const std::vector<DepthImage>& frames, std::size_t first, std::size_t count) {
    DepthImage mean = frames[first];
    for (std::size_t k = 0; k < mean.levels.size(); ++k) {
        double sum = 0.0;
        for (std::size_t n = first; n < first + count; ++n)
            sum += static_cast<double>(frames[n].levels[k]);
        mean.levels[k] = static_cast<float>(sum / static_cast<double>(count));
    }
    return mean;
}

}  // namespace dibhr::bench
