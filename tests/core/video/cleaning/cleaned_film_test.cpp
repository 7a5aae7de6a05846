// A noisy camera's film, cleaned with the program's defaults, against the truth: the short form of
// tests/bench/truth.
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "core/video/playing/frame_reader.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/listed_media.hpp"
#include "tests/support/noisy_scene.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kFrames = 14;
constexpr int kReach = 5;              // of the chain, in time
constexpr double kLevelsOfPx = 257.0;  // 16 bits over 255 px
constexpr double kNoise_px = 0.5;
constexpr double kWall_px = 60.0;
constexpr double kHand_px = 120.0;

double hand_begins(int frame) {
    return 30.0 + 4.0 * frame;
}

/// A hand that moves 4 px a frame over a wall, and a chest below it that breathes.
double elevation_px(int frame, int i, int j) {
    const double begins = hand_begins(frame);
    if (i >= begins && i < begins + 45.0 && j >= 10 && j < 70) return kHand_px + 0.1 * j;
    const double x = (i - 80.0) / 25.0;
    const double y = (j - 100.0) / 10.0;
    const double breath_px = 12.0 + 4.0 * std::sin(2.0 * std::numbers::pi * frame / 120.0);
    return kWall_px + 0.1 * i + breath_px * std::exp(-x * x - y * y);
}

NoisyScene seen_by_a_sensor() {
    return {[](int frame, int i, int j) { return kLevelsOfPx * elevation_px(frame, i, j); },
            [](double) { return kLevelsOfPx * kNoise_px; }, 160, 120, 65535.0};
}

/// Rounded to whole levels, as from a sensor.
std::vector<DepthImage> recorded(const NoisyScene& scene) {
    std::vector<DepthImage> frames = scene.frames(kFrames);
    for (DepthImage& frame : frames)
        for (float& level : frame.levels) level = std::round(level);
    return frames;
}

std::vector<DepthImage> cleaned_by_default(const std::vector<DepthImage>& frames) {
    FrameReader reader(std::make_unique<ListedMedia>(frames, 1.0 / 30.0));
    reader.set_cleaning({});
    std::vector<DepthImage> cleaned;
    for (auto frame = reader.at(0.0); frame; frame = reader.after(frame->media_s))
        cleaned.push_back(*frame->depth);
    UNSCOPED_INFO(in_words({}, reader.plan()));
    return cleaned;
}

/// The column at which the row rises onto the hand.
int step_in_row(const DepthImage& image, int row) {
    for (int i = 0; i < image.columns; ++i)
        if (image.at(i, row) > 0.5 * (kWall_px + kHand_px) * kLevelsOfPx) return i;
    return -1;
}

/// The level of the top of the chest.
double mean_px(const DepthImage& image) {
    double sum = 0.0;
    int count = 0;
    for (int j = 96; j < 105; ++j)
        for (int i = 70; i < 90; ++i, ++count) sum += image.at(i, j);
    return sum / count / kLevelsOfPx;
}

/// Mean of the absolute errors: in a mean of squares one pixel beside its outline would dominate.
double error_px(const DepthImage& image, const DepthImage& truth) {
    double sum = 0.0;
    for (std::size_t n = 0; n < truth.levels.size(); ++n)
        sum += std::fabs(static_cast<double>(image.levels[n] - truth.levels[n]));
    return sum / static_cast<double>(truth.levels.size()) / kLevelsOfPx;
}

}  // namespace

TEST_CASE("a noisy film is nearer to the truth when it is cleaned by default, sharp and in time",
          "[cleaning]") {
    const NoisyScene scene = seen_by_a_sensor();
    const std::vector<DepthImage> seen = recorded(scene);
    const std::vector<DepthImage> cleaned = cleaned_by_default(seen);
    REQUIRE(cleaned.size() == seen.size());
    double seen_px = 0.0;
    double cleaned_px = 0.0;
    for (int k = 0; k < kFrames; ++k) {
        const auto n = static_cast<std::size_t>(k);
        const DepthImage truth = scene.truth(k);
        CAPTURE(k);
        seen_px += error_px(seen[n], truth) / kFrames;
        cleaned_px += error_px(cleaned[n], truth) / kFrames;
        for (int row = 15; row < 65; row += 5)
            CHECK(std::abs(step_in_row(cleaned[n], row) - step_in_row(truth, row)) <= 1);
        const bool sees_both_sides = k >= kReach && k + kReach < kFrames;
        // The chest breathes 0.2 levels a frame.
        if (sees_both_sides) CHECK(std::fabs(mean_px(cleaned[n]) - mean_px(truth)) < 0.1);
    }
    CAPTURE(seen_px, cleaned_px);
    CHECK(cleaned_px < 0.5 * seen_px);
}
