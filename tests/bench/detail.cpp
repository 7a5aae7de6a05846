// Formulas for the panels, and their measures.
#include "tests/bench/detail.hpp"

#include <algorithm>
#include <cmath>
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

std::size_t panel_at(double y_px) {
    return static_cast<std::size_t>(y_px + 0.5) / static_cast<std::size_t>(kPanelRows);
}

/// Towards the camera, from the plane.
double measured_mm(const DepthImage& depth, int i, int j, double x_px) {
    const auto level = static_cast<double>(depth.at(i, j));
    return plane_mm(x_px) - distance_mm(level * kRelief_px / depth.highest_level);
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

KnownScene detail_scene(double px_per_frame) {
    KnownScene scene{.name = "detail", .columns = kColumns, .rows = kRows};
    scene.moves = px_per_frame != 0.0;
    scene.at = [px_per_frame](double frame, double x, double y) {
        const double x_px = x + px_per_frame * frame;
        return Seen{elevation_px(plane_mm(x_px) - relief_mm(panel_at(y), x_px)), 0};
    };
    return scene;
}

std::vector<ColourImage> detail_colours(double px_per_frame, int frames, std::uint32_t seed) {
    constexpr double kMean = 128.0, kNoise = 2.0;
    constexpr int kTexture = 3;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, kNoise);
    std::vector<ColourImage> colours;
    for (int k = 0; k < frames; ++k) {
        ColourImage& colour = colours.emplace_back(ColourImage{kColumns, kRows, {}});
        for (int j = 0; j < kRows; ++j)
            for (int i = 0; i < kColumns; ++i) {
                const double bright =
                    kMean + test::texture(i + px_per_frame * k, j, kTexture) + normal(random);
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
    for (std::size_t panel = 0; panel < kStepPanel; ++panel)
        for (int j = first_row(panel); j < end_row(panel); ++j)
            for (int i = kMargin_px; i < kColumns - kMargin_px; ++i) {
                const double x_px = i + px_per_frame_ * frame;
                const double measured = measured_mm(depth, i, j, x_px);
                if (panel == kFlatPanel) {
                    squares_mm2_ += measured * measured;
                    pixels_ += 1.0;
                } else {
                    ridges_[panel - 1].add(relief_mm(panel, x_px), measured);
                }
            }
    add_steps(frame, depth);
    flat_.add(flat_panel(depth), flat_panel(next));
}

/// Of the mean of all rows, between columns.
void DetailMeter::add_steps(int frame, const DepthImage& depth) {
    const double gone_px = px_per_frame_ * frame;
    std::vector<double> profile_mm(kColumns, 0.0);
    constexpr int kMeasuredRows = kPanelRows - 2 * kPanelMargin_px;
    for (int j = first_row(kStepPanel); j < end_row(kStepPanel); ++j)
        for (int i = 0; i < kColumns; ++i)
            profile_mm[static_cast<std::size_t>(i)] +=
                measured_mm(depth, i, j, i + gone_px) / kMeasuredRows;
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
    detail.step = rise_mm_ / rises_ / kStep_mm;
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
