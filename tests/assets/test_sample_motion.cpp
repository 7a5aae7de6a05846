// The person of the sample moves: breathes, turns, reaches out, blinks, and the loop has no seam.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>

#include "assets/sample/pose.hpp"
#include "tests/assets/sample_files.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::sample::kFrames;
using dibhr::sample::pose_at;
using dibhr::test::sample_video;

/// Mean difference from each frame to the next [levels]; the last one is from the end to the start.
std::vector<double> steps(const std::vector<cv::Mat>& frames) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const cv::Mat& next = frames[(i + 1) % frames.size()];
        differences.push_back(cv::norm(frames[i], next, cv::NORM_L1) /
                              static_cast<double>(frames[i].total()));
    }
    return differences;
}

/// A mean over an area of each depth frame [levels].
std::vector<double> levels_of(cv::Rect area) {
    std::vector<double> levels;
    for (const cv::Mat& depth : sample_video().depth) levels.push_back(cv::mean(depth(area))[0]);
    return levels;
}

double span(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
}

/// How often a periodic signal rises through the middle of its range.
int cycles(const std::vector<double>& values) {
    const double middle = *std::min_element(values.begin(), values.end()) + 0.5 * span(values);
    int rises = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] < middle && values[(i + 1) % values.size()] >= middle) ++rises;
    return rises;
}

}  // namespace

TEST_CASE("from the last frame to the first is a step like any other", "[sample]") {
    REQUIRE(sample_video().depth.size() == static_cast<std::size_t>(kFrames));
    REQUIRE(sample_video().colour.size() == static_cast<std::size_t>(kFrames));
    for (const auto* frames : {&sample_video().depth, &sample_video().colour}) {
        std::vector<double> step = steps(*frames);
        const double seam = step.back();
        step.pop_back();
        // A little more: the first frame is coded alone and keeps finer grain than the last.
        CHECK(seam <= 1.25 * *std::max_element(step.begin(), step.end()));
        CHECK(seam > 0.0);
    }
}

TEST_CASE("the hand comes nearer by more than 50 levels and goes back", "[sample]") {
    const auto palm = levels_of({495, 285, 50, 40});
    REQUIRE(palm.size() == static_cast<std::size_t>(kFrames));
    const auto nearest = std::max_element(palm.begin(), palm.end());
    CHECK(*nearest - palm.front() > 50.0);
    CHECK(*nearest - palm.back() > 50.0);
    CHECK(nearest - palm.begin() > kFrames / 3);
    CHECK(nearest - palm.begin() < 2 * kFrames / 3);
}

TEST_CASE("the chest breathes three times in a loop, by 6 to 15 levels", "[sample]") {
    const auto chest = levels_of({290, 430, 60, 30});
    REQUIRE(chest.size() == static_cast<std::size_t>(kFrames));
    CHECK(span(chest) > 6.0);
    CHECK(span(chest) < 15.0);
    CHECK(cycles(chest) == 3);
}

TEST_CASE("every pose returns after one loop", "[sample]") {
    const auto frame = static_cast<float>(GENERATE(0, 40, 52, 133, 299));
    const auto now = pose_at(frame), later = pose_at(frame + kFrames);
    CHECK(glm::length(now.palm - later.palm) < 0.01F);
    CHECK(glm::length(now.head_origin - later.head_origin) < 0.01F);
    CHECK(glm::length(now.gaze - later.gaze) < 0.001F);
    CHECK_THAT(now.eye_opening, Catch::Matchers::WithinAbs(later.eye_opening, 1e-3));
}

TEST_CASE("the eyes blink twice in a loop and are open most of the time", "[sample]") {
    std::vector<double> opening;
    for (int frame = 0; frame < kFrames; ++frame)
        opening.push_back(pose_at(static_cast<float>(frame)).eye_opening);
    CHECK(cycles(opening) == 2);
    CHECK(std::count_if(opening.begin(), opening.end(), [](double x) { return x > 0.99; }) >
          kFrames * 9 / 10);
}

TEST_CASE("the head turns to both sides, and the eyes stay on the viewer", "[sample]") {
    float leftmost = 0.0F, rightmost = 0.0F;
    for (int frame = 0; frame < kFrames; ++frame) {
        const auto pose = pose_at(static_cast<float>(frame));
        const auto forward =
            glm::transpose(pose.head_from_world) * dibhr::sample::Vec3{0.0F, 0.0F, 1.0F};
        leftmost = std::min(leftmost, forward.x);
        rightmost = std::max(rightmost, forward.x);
        const dibhr::sample::Vec3 gaze{
            pose.gaze.x, pose.gaze.y,
            std::sqrt(1.0F - pose.gaze.x * pose.gaze.x - pose.gaze.y * pose.gaze.y)};
        CHECK((glm::transpose(pose.head_from_world) * gaze).z > 0.9999F);
    }
    CHECK(leftmost < -0.08F);
    CHECK(rightmost > 0.08F);
}
